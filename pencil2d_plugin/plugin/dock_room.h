// Room for the lamp's panel and materials while it is in use.
#pragma once

#include "host/host.h"

#include <QList>
#include <QPointer>

namespace lampblack
{

/// Makes the docks that hold our widgets taller at their neighbours' cost, and gives the room back.
class DockRoom : public QObject
{
    Q_OBJECT

public:
    explicit DockRoom(Host& host, QObject* parent = nullptr);

private:
    void take();
    void giveBack();

    struct Height
    {
        QPointer<QDockWidget> dock;
        int pixels;
    };
    Host& mHost;
    QList<Height> mBefore; ///< of every dock, while we have the room
};

} // namespace lampblack
