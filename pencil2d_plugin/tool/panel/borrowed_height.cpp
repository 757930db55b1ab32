#include "tool/panel/borrowed_height.h"

#include <QEvent>
#include <QLayout>
#include <QMainWindow>
#include <QTimer>

#include <algorithm>
#include <utility>

namespace lampblack
{

namespace
{

constexpr int LeastHeight = 330; ///< pixels in which a light and its numbers can be seen

QDockWidget* dockAround(const QWidget& page)
{
    for (QWidget* above = page.parentWidget(); above != nullptr; above = above->parentWidget())
    {
        if (auto* dock = qobject_cast<QDockWidget*>(above))
            return dock;
    }
    return nullptr;
}

QMainWindow* windowOf(const QDockWidget* dock)
{
    return dock == nullptr || dock->isFloating() ? nullptr : qobject_cast<QMainWindow*>(dock->parentWidget());
}

/// The docks at the sides of the window, the lowest first.
QList<QDockWidget*> docksBeside(const QMainWindow& window)
{
    QList<QDockWidget*> beside;
    const auto docks = window.findChildren<QDockWidget*>(QString(), Qt::FindDirectChildrenOnly);
    for (QDockWidget* dock : docks)
    {
        const Qt::DockWidgetArea area = window.dockWidgetArea(dock);
        if (dock->isVisible() && !dock->isFloating() &&
            (area == Qt::LeftDockWidgetArea || area == Qt::RightDockWidgetArea))
            beside << dock;
    }
    std::sort(beside.begin(), beside.end(),
              [](const QDockWidget* a, const QDockWidget* b) { return a->y() > b->y(); });
    return beside;
}

bool isBelow(const QDockWidget& dock, const QDockWidget& other)
{
    return dock.y() > other.y() && dock.x() < other.x() + other.width() &&
           other.x() < dock.x() + dock.width();
}

} // namespace

void BorrowedHeight::borrow(const QWidget& page, int wanted)
{
    if (!mUnfolded.isEmpty())
        return;
    mNeighbours.clear();
    mDock = dockAround(page);
    QMainWindow* window = windowOf(mDock);
    if (window == nullptr)
        return;
    // The docks of the other side are set too: Qt may change the height of a dock that is left out.
    const int target =
        std::max(mDock->height(), mLastHeight > 0 ? mLastHeight : std::min(wanted, window->height() / 2));
    int needed = target - mDock->height();
    const QList<QDockWidget*> docks = docksBeside(*window);
    const int index = docks.indexOf(mDock);
    if (index < 0)
        return; // it is at the top or bottom edge
    QList<QDockWidget*> below;
    for (QDockWidget* dock : docks)
    {
        if (isBelow(*dock, *mDock))
            below = QList<QDockWidget*>{dock} + window->tabifiedDockWidgets(dock) + below;
        const int spare = std::max(0, dock->height() - dock->minimumSizeHint().height());
        const int given = isBelow(*dock, *mDock) ? std::min(needed, spare) : 0;
        needed -= given;
        mNeighbours << Neighbour{dock, dock->height(), dock->height() - given};
    }
    // Without enough below, the docks above lend what they can spare.
    for (Neighbour& neighbour : mNeighbours)
    {
        const int spare = std::max(0, neighbour.before - neighbour.dock->minimumSizeHint().height());
        if (below.isEmpty() && isBelow(*mDock, *neighbour.dock) && target - needed < LeastHeight)
        {
            const int given = std::min({needed, spare, LeastHeight - (target - needed)});
            neighbour.height -= given;
            needed -= given;
        }
    }
    mNeighbours[index].height = target - needed;
    if (target - needed < std::min(LeastHeight, wanted) && !below.isEmpty())
        fold(below);
    else
        resize(&Neighbour::height);
}

void BorrowedHeight::giveBack()
{
    if (!mUnfolded.isEmpty())
    {
        unfold();
        mNeighbours.clear();
        return;
    }
    if (mDock != nullptr && !mNeighbours.isEmpty() && !mDock->isFloating())
        mLastHeight = mDock->height();
    resize(&Neighbour::before);
    mNeighbours.clear();
}

void BorrowedHeight::fold(const QList<QDockWidget*>& below)
{
    QMainWindow* window = windowOf(mDock);
    mUnfolded = window->saveState();
    int height = 0;
    for (QDockWidget* dock : below)
    {
        if (!dock->visibleRegion().isEmpty()) // not a tab behind another
            height += dock->height();
        window->tabifyDockWidget(mDock, dock);
    }
    mDock->raise();
    window->installEventFilter(this);
    // The tabs have the room of all of them; the docks above keep theirs.
    QVector<Neighbour> column;
    for (const Neighbour& neighbour : qAsConst(mNeighbours))
    {
        if (neighbour.dock == mDock)
            column << Neighbour{neighbour.dock, neighbour.before, neighbour.before + height};
        else if (!below.contains(neighbour.dock))
            column << Neighbour{neighbour.dock, neighbour.before, neighbour.before};
    }
    mNeighbours = column;
    resize(&Neighbour::height);
}

void BorrowedHeight::unfold()
{
    const QByteArray state = std::exchange(mUnfolded, QByteArray());
    QMainWindow* window = windowOf(mDock);
    if (window == nullptr)
        return;
    window->removeEventFilter(this);
    // Docks that the artist has opened or closed meanwhile stay so.
    const auto docks = window->findChildren<QDockWidget*>(QString(), Qt::FindDirectChildrenOnly);
    QVector<bool> closed;
    for (const QDockWidget* dock : docks)
        closed << dock->isHidden();
    window->restoreState(state);
    for (int place = 0; place < docks.size(); ++place)
        docks[place]->setVisible(!closed[place]);
}

bool BorrowedHeight::eventFilter(QObject*, QEvent* event)
{
    if (event->type() == QEvent::Close)
        giveBack();
    return false;
}

void BorrowedHeight::resize(int Neighbour::*height)
{
    QMainWindow* window = windowOf(mDock);
    if (window == nullptr)
        return;
    const auto apply = [window, column = mNeighbours, height]
    {
        QList<QDockWidget*> docks;
        QList<int> heights;
        for (const Neighbour& neighbour : column)
        {
            if (!neighbour.dock || neighbour.dock->isFloating())
                continue;
            docks << neighbour.dock;
            heights << neighbour.*height;
        }
        window->resizeDocks(docks, heights, Qt::Vertical);
    };
    // If several docks change at once, Qt sets their heights only the second time. The first is laid out
    // before it is painted: the docks would not fill their column.
    apply();
    window->layout()->activate();
    apply();
    QTimer::singleShot(0, window, apply);
}

} // namespace lampblack
