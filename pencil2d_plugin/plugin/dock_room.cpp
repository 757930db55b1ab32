#include "plugin/dock_room.h"

#include <QMainWindow>

namespace lampblack
{

namespace
{
constexpr int Wanted = 280;
}

DockRoom::DockRoom(Host& host, QObject* parent) : QObject(parent), mHost(host)
{
    // Queued: the panel is put into its dock on the same signal.
    connect(
        &host, &Host::toolActivated, this, [this](bool active) { active ? take() : giveBack(); },
        Qt::QueuedConnection);
}

void DockRoom::take()
{
    auto* window = qobject_cast<QMainWindow*>(mHost.window());
    auto* materials =
        window ? window->findChild<QDockWidget*>(QStringLiteral("lampblack.materials")) : nullptr;
    if (materials == nullptr || materials->isFloating() || !mBefore.isEmpty() ||
        materials->height() >= Wanted)
        return;
    for (auto* dock : window->findChildren<QDockWidget*>(QString(), Qt::FindDirectChildrenOnly))
        if (window->dockWidgetArea(dock) == window->dockWidgetArea(materials))
            mBefore.append({dock, dock->height()});
    window->resizeDocks({materials}, {qMin(Wanted, window->height() / 3)}, Qt::Vertical);
}

void DockRoom::giveBack()
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
    if (window != nullptr && !docks.isEmpty())
        window->resizeDocks(docks, heights, Qt::Vertical);
}

} // namespace lampblack
