// Asks before another project replaces the open one.
#pragma once

#include "host/parts.h"

#include <QMenu>

#include <functional>

namespace lampblack
{

/// Pencil2D asks by itself if it knows of changes, but it does not know of ours. This class handles New, Open
/// and recent files, by shortcut and by menu.
class LeaveGuard : public QObject
{
    Q_OBJECT

public:
    LeaveGuard(const Parts& parts, QObject* parent);
    ~LeaveGuard() override;

    /// `mayLeave` may ask the artist; false keeps the project open.
    void setMayLeave(std::function<bool()> mayLeave) { mMayLeave = std::move(mayLeave); }

    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    struct StandIn
    {
        QPointer<QAction> original;
        QPointer<QAction> action;
    };
    void guardMenu(QMenu* menu);
    QVector<QAction*> leavingActions(const QMenu& menu) const;
    void replace(QMenu* menu);
    void restoreActions();

    Parts mParts;
    std::function<bool()> mMayLeave;
    QVector<StandIn> mStandIns; ///< while a menu is open
};

} // namespace lampblack
