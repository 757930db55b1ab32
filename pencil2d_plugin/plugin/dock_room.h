// Brings the materials dock in front, and makes it higher, while the lamp tool is in use.
#pragma once

#include "host/host.h"

#include <QList>
#include <QPointer>

namespace lampblack
{

/// Takes the height from the other docks of the same area, and restores it afterwards.
class DockRoom : public QObject
{
    Q_OBJECT

public:
    explicit DockRoom(Host& host, QObject* parent = nullptr);

private:
    void makeRoom();
    void restoreHeights();

    struct Height
    {
        QPointer<QDockWidget> dock;
        int pixels;
    };
    Host& mHost;
    QList<Height> mBefore;          ///< heights of all docks of the area; empty while none is changed
    QPointer<QDockWidget> mInFront; ///< the tab that was in front of the materials; null if none was
};

} // namespace lampblack
