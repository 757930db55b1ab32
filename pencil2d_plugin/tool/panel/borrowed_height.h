// Gives a dock more height for a while, taken from the docks below it.
#pragma once

#include <QDockWidget>
#include <QPointer>
#include <QVector>
#include <QWidget>

namespace lampblack
{

/// The dock of the tool options is low, because other tools have few options. While the lamp's panel is
/// shown, the dock is made higher. The docks below shrink, and all heights are restored afterwards.
class BorrowedHeight
{
public:
    /// Grow the dock around `page` to `wanted` pixels, or to what it had when it was last given back. Half
    /// of the window is the most. Does nothing outside a docked dock.
    void borrow(const QWidget& page, int height);
    void giveBack();

private:
    struct Neighbour
    {
        QPointer<QDockWidget> dock;
        int before = 0;
        int height = 0;
    };
    void resize(int Neighbour::*height);

    QPointer<QDockWidget> mDock;
    QVector<Neighbour> mNeighbours; ///< and the dock itself, while it is higher
    int mLastHeight = 0;            ///< height that the artist left it with
};

} // namespace lampblack
