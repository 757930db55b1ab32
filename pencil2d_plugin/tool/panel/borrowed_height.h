// Height that a dock takes from the docks below it for a while.
#pragma once

#include <QDockWidget>
#include <QPointer>
#include <QVector>
#include <QWidget>

namespace lampblack
{

/// Other tools have few options, and their dock is low. While the lamp's panel shows, the dock grows; docks
/// above it stay as they are, those below make room, and all have their heights back afterwards.
class BorrowedHeight
{
public:
    /// Grow the dock around `page` to `wanted` pixels, or to what it had when it was last given back. Half
    /// of the window is the most. Does nothing outside a docked dock.
    void borrow(const QWidget& page, int wanted);
    void giveBack();

private:
    struct Neighbour
    {
        QPointer<QDockWidget> dock;
        int before = 0;
        int wanted = 0;
    };
    void resize(int Neighbour::*height);

    QPointer<QDockWidget> mDock;
    QVector<Neighbour> mNeighbours; ///< and the dock itself, while it borrows
    int mLast = 0;                  ///< height that the artist left it with
};

} // namespace lampblack
