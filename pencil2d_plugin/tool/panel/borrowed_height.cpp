#include "tool/panel/borrowed_height.h"

#include <QMainWindow>

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

/// The docks above and below `dock` and itself, from above.
QList<QDockWidget*> columnOf(const QMainWindow& window, const QDockWidget& dock)
{
    QList<QDockWidget*> column;
    const auto docks = window.findChildren<QDockWidget*>(QString(), Qt::FindDirectChildrenOnly);
    for (QDockWidget* other : docks)
    {
        const bool overlaps = other->x() < dock.x() + dock.width() && dock.x() < other->x() + other->width();
        if (other->isVisible() && !other->isFloating() && overlaps &&
            window.dockWidgetArea(other) == window.dockWidgetArea(const_cast<QDockWidget*>(&dock)))
            column << other;
    }
    std::sort(column.begin(), column.end(),
              [](const QDockWidget* a, const QDockWidget* b) { return a->y() < b->y(); });
    return column;
}

} // namespace

void BorrowedHeight::borrow(const QWidget& page, int wanted)
{
    mBefore.clear();
    mDock = dockAround(page);
    QMainWindow* window = windowOf(mDock);
    if (window == nullptr)
        return;
    const QList<QDockWidget*> column = columnOf(*window, *mDock);
    const int place = column.indexOf(mDock);
    QList<int> heights;
    for (QDockWidget* dock : column)
    {
        mBefore << Neighbour{dock, dock->height()};
        heights << dock->height();
    }
    const int asked = mLast > 0 ? mLast : std::min(wanted, window->height() / 2);
    for (int below = column.size() - 1; below > place; --below)
    {
        const int spare = heights[below] - column[below]->minimumSizeHint().height();
        const int lent = std::clamp(asked - heights[place], 0, std::max(0, spare));
        heights[below] -= lent;
        heights[place] += lent;
    }
    window->resizeDocks(column, heights, Qt::Vertical);
}

void BorrowedHeight::giveBack()
{
    QMainWindow* window = windowOf(mDock);
    if (window != nullptr && !mBefore.isEmpty())
    {
        mLast = mDock->height();
        QList<QDockWidget*> docks;
        QList<int> heights;
        for (const Neighbour& neighbour : qAsConst(mBefore))
        {
            if (!neighbour.dock || neighbour.dock->isFloating())
                continue;
            docks << neighbour.dock;
            heights << neighbour.height;
        }
        window->resizeDocks(docks, heights, Qt::Vertical);
    }
    mBefore.clear();
}

} // namespace lampblack
