#include "host/leave_guard.h"

#include <QEvent>

namespace lampblack
{

namespace
{
constexpr const char* RecentFilesClass = "RecentFileMenu";
}

LeaveGuard::LeaveGuard(const Parts& parts, QObject* parent) : QObject(parent), mParts(parts)
{
    for (const char* name : {"actionNew", "actionOpen"})
    {
        if (QAction* action = parts.action(name))
            action->installEventFilter(this);
    }
    auto* file =
        parts.window == nullptr ? nullptr : parts.window->findChild<QMenu*>(QStringLiteral("menuFile"));
    if (file == nullptr)
        return;
    guardMenu(file);
    const auto entries = file->actions();
    for (const QAction* entry : entries)
    {
        if (entry->menu() != nullptr && isClass(entry->menu(), RecentFilesClass))
            guardMenu(entry->menu());
    }
}

LeaveGuard::~LeaveGuard()
{
    restoreActions();
}

bool LeaveGuard::eventFilter(QObject*, QEvent* event)
{
    return event->type() == QEvent::Shortcut && mMayLeave && !mMayLeave();
}

void LeaveGuard::guardMenu(QMenu* menu)
{
    connect(menu, &QMenu::aboutToShow, this, [this, menu] { replace(menu); });
    // Queued, because an entry is triggered just after its menu is hidden.
    connect(menu, &QMenu::aboutToHide, this, &LeaveGuard::restoreActions, Qt::QueuedConnection);
}

QVector<QAction*> LeaveGuard::leavingActions(const QMenu& menu) const
{
    QVector<QAction*> leaving;
    const auto actions = menu.actions();
    for (QAction* action : actions)
    {
        if (isClass(&menu, RecentFilesClass))
        {
            if (action->isSeparator()) // the entry below it clears the list
                break;
            leaving << action;
        }
        else if (action == mParts.action("actionNew") || action == mParts.action("actionOpen"))
        {
            leaving << action;
        }
    }
    return leaving;
}

void LeaveGuard::replace(QMenu* menu)
{
    const auto leaving = leavingActions(*menu);
    for (QAction* original : leaving)
    {
        if (!original->isVisible())
            continue;
        // The effect of an action cannot be stopped, so another action replaces it while the menu is open.
        auto* standIn = new QAction(original->icon(), original->text(), menu);
        standIn->setShortcut(original->shortcut());
        standIn->setEnabled(original->isEnabled());
        menu->insertAction(original, standIn);
        original->setVisible(false);
        mStandIns.append(StandIn{original, standIn});
        const QPointer<QAction> wanted = original;
        connect(
            standIn, &QAction::triggered, this,
            [this, wanted]
            {
                if (wanted && (!mMayLeave || mMayLeave()) && wanted)
                    wanted->trigger();
            },
            Qt::QueuedConnection);
    }
}

void LeaveGuard::restoreActions()
{
    for (const StandIn& each : qAsConst(mStandIns))
    {
        if (each.original)
            each.original->setVisible(true);
        if (each.action)
        {
            each.action->setVisible(false);
            each.action->deleteLater();
        }
    }
    mStandIns.clear();
}

} // namespace lampblack
