#include "plugin/dock_room.h"

#include <QMainWindow>

namespace lampblack
{

namespace
{
constexpr int MaterialsHeight = 280; // pixels
}

DockRoom::DockRoom(Host& host, QObject* parent) : QObject(parent), mHost(host)
{
    // Queued, because the host puts the panel into its dock on the same signal.
    connect(
        &host, &Host::toolActivated, this, [this](bool active) { active ? makeRoom() : restoreHeights(); },
        Qt::QueuedConnection);
}

void DockRoom::makeRoom()
{
    auto* window = qobject_cast<QMainWindow*>(mHost.window());
    auto* materials =
        window ? window->findChild<QDockWidget*>(QStringLiteral("lampblack.materials")) : nullptr;
    if (materials == nullptr || materials->isHidden() || materials->isFloating() || !mBefore.isEmpty())
        return;
    const auto beside = window->tabifiedDockWidgets(materials);
    for (QDockWidget* dock : beside)
        if (!dock->visibleRegion().isEmpty())
            mInFront = dock;
    materials->raise();
    if (materials->height() >= MaterialsHeight)
        return;
    for (auto* dock : window->findChildren<QDockWidget*>(QString(), Qt::FindDirectChildrenOnly))
        if (window->dockWidgetArea(dock) == window->dockWidgetArea(materials))
            mBefore.append({dock, dock->height()});
    window->resizeDocks({materials}, {qMin(MaterialsHeight, window->height() / 3)}, Qt::Vertical);
}

void DockRoom::restoreHeights()
{
    auto* window = qobject_cast<QMainWindow*>(mHost.window());
    QList<QDockWidget*> docks;
    QList<int> heights;
    for (const Height& before : qAsConst(mBefore))
        if (before.dock && !before.dock->isFloating())
        {
            docks.append(before.dock);
            heights.append(before.pixels);
        }
    mBefore.clear();
    if (mInFront)
        mInFront->raise();
    mInFront.clear();
    if (window != nullptr && !docks.isEmpty())
        window->resizeDocks(docks, heights, Qt::Vertical);
}

} // namespace lampblack
