#include "tool/panel/borrowed_height.h"

#include <QMainWindow>
#include <QTimer>

#include <algorithm>

namespace lampblack
{

namespace
{

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

void BorrowedHeight::borrow(const QWidget& page, int height)
{
    mNeighbours.clear();
    mDock = dockAround(page);
    QMainWindow* window = windowOf(mDock);
    if (window == nullptr)
        return;
    // The docks of the other side are set too: Qt may change the height of a dock that is left out.
    const int target =
        std::max(mDock->height(), mLastHeight > 0 ? mLastHeight : std::min(height, window->height() / 2));
    int needed = target - mDock->height();
    const QList<QDockWidget*> docks = docksBeside(*window);
    const int index = docks.indexOf(mDock);
    if (index < 0)
        return; // it is at the top or bottom edge
    for (QDockWidget* dock : docks)
    {
        const int spare = std::max(0, dock->height() - dock->minimumSizeHint().height());
        const int given = isBelow(*dock, *mDock) ? std::min(needed, spare) : 0;
        needed -= given;
        mNeighbours << Neighbour{dock, dock->height(), dock->height() - given};
    }
    mNeighbours[index].height = target - needed;
    resize(&Neighbour::height);
}

void BorrowedHeight::giveBack()
{
    if (mDock != nullptr && !mNeighbours.isEmpty() && !mDock->isFloating())
        mLastHeight = mDock->height();
    resize(&Neighbour::before);
    mNeighbours.clear();
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
    apply();
    // If several docks change at once, Qt sets their heights only the second time.
    QTimer::singleShot(0, window, apply);
}

} // namespace lampblack
