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

/// The docks at the sides of the window, from below.
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
    mNeighbours.clear();
    mDock = dockAround(page);
    QMainWindow* window = windowOf(mDock);
    if (window == nullptr)
        return;
    // Those on the other side are told to stay: a dock that is not spoken of may be moved.
    const int asked = std::max(mDock->height(), mLast > 0 ? mLast : std::min(wanted, window->height() / 2));
    int missing = asked - mDock->height();
    const QList<QDockWidget*> docks = docksBeside(*window);
    const int own = docks.indexOf(mDock);
    if (own < 0)
        return; // along the top or bottom edge
    for (QDockWidget* dock : docks)
    {
        const int spare = std::max(0, dock->height() - dock->minimumSizeHint().height());
        const int lent = isBelow(*dock, *mDock) ? std::min(missing, spare) : 0;
        missing -= lent;
        mNeighbours << Neighbour{dock, dock->height(), dock->height() - lent};
    }
    mNeighbours[own].wanted = asked - missing;
    resize(&Neighbour::wanted);
}

void BorrowedHeight::giveBack()
{
    if (mDock != nullptr && !mNeighbours.isEmpty() && !mDock->isFloating())
        mLast = mDock->height();
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
    // Where several docks change at once, Qt brings them to their heights only the second time.
    QTimer::singleShot(0, window, apply);
}

} // namespace lampblack
