// Gives a dock more height for a while, taken from the docks below it.
#pragma once

#include <QDockWidget>
#include <QObject>
#include <QPointer>
#include <QVector>
#include <QWidget>

namespace lampblack
{

/// The dock of the tool options is low, because other tools have few options. While the lamp's panel is
/// shown, the dock is made higher: the docks below shrink. If that is not enough, as on a small screen, they
/// become tabs of the dock. All is restored afterwards.
class BorrowedHeight : public QObject
{
    Q_OBJECT

public:
    /// Grow the dock around `page` to `wanted` pixels, or to what it had when it was last given back. Half
    /// of the window is the most. Does nothing outside a docked dock.
    void borrow(const QWidget& page, int wanted);
    void giveBack();

    /// Gives back before the window closes: the program keeps the places of its docks then.
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    struct Neighbour
    {
        QPointer<QDockWidget> dock;
        int before = 0;
        int height = 0;
    };
    void resize(int Neighbour::*height);
    void fold(const QList<QDockWidget*>& below);
    void unfold();

    QPointer<QDockWidget> mDock;
    QVector<Neighbour> mNeighbours; ///< and the dock itself, while it is higher
    QByteArray mUnfolded;           ///< the places of all docks before they became tabs; empty if none did
    int mLastHeight = 0;            ///< height that the artist left it with
};

} // namespace lampblack
