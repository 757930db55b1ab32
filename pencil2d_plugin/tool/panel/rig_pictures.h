// Pictures of the current drawing for the menu of lights.
#pragma once

#include "host/host.h"
#include "tool/panel/rig_menu.h"
#include "worker/worker.h"

#include <QCache>

namespace lampblack
{

/// Asks for them whenever the menu opens. Until they come, the menu shows those that came last for the frame.
class RigPictures : public QObject
{
    Q_OBJECT

public:
    RigPictures(Host& host, Worker& worker, RigMenu& menu);

private:
    void onOpened();

    Host& mHost;
    Worker& mWorker;
    RigMenu& mMenu;
    QCache<int, QVector<RigSketch>> mKept; ///< by frame
};

} // namespace lampblack
