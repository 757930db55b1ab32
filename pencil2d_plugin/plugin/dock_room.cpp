#include "plugin/dock_room.h"

#include <QMainWindow>

namespace lampblack
{

namespace
{

struct Wish
{
    const char* name;
    int pixels;
};
constexpr Wish Wishes[] = {{"lampblack.panel", 460}, {"lampblack.materials", 280}};

QDockWidget* dockOf(QWidget* widget)
{
    while (widget != nullptr && qobject_cast<QDockWidget*>(widget) == nullptr)
        widget = widget->parentWidget();
    return qobject_cast<QDockWidget*>(widget);
}

void resize(QMainWindow& window, const QList<QDockWidget*>& docks, const QList<int>& heights)
{
    if (!docks.isEmpty())
        window.resizeDocks(docks, heights, Qt::Vertical);
}

} // namespace

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
    if (window == nullptr || !mBefore.isEmpty())
        return;
    for (auto* dock : window->findChildren<QDockWidget*>())
        mBefore.append({dock, dock->height()});
    QList<QDockWidget*> docks;
    QList<int> heights;
    for (const Wish& wish : Wishes)
    {
        auto* dock = dockOf(window->findChild<QWidget*>(QLatin1String(wish.name)));
        if (dock != nullptr && !dock->isFloating() && dock->height() < wish.pixels)
        {
            docks.append(dock);
            heights.append(qMin(wish.pixels, window->height() / 2));
        }
    }
    resize(*window, docks, heights);
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
    if (window != nullptr)
        resize(*window, docks, heights);
}

} // namespace lampblack
