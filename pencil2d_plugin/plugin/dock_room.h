// Room for the materials while the lamp is in use.
#pragma once

#include "host/host.h"

#include <QList>
#include <QPointer>

namespace lampblack
{

/// Makes the materials' dock taller at the cost of those in its area, and gives the room back.
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
    QList<Height> mBefore; ///< of every dock of the area, while we have the room
};

} // namespace lampblack
