// Asks where the drawing overlaps itself, for the Depth view.
#pragma once

#include "host/host.h"
#include "plugin/frame_feed.h"
#include "scene/scene_document.h"
#include "tool/lamp_tool.h"
#include "worker/worker.h"

#include <QTimer>

namespace lampblack
{

/// While the tool shows the depth, it keeps the overlaps of the current frame up to date: after a change of
/// the frame, its drawing, or what the scene says of depth.
class CutFeed : public QObject
{
    Q_OBJECT

public:
    CutFeed(Host& host, Worker& worker, FrameFeed& feed, SceneDocument& document, LampTool& tool,
            QObject* parent = nullptr);

private:
    void ask();

    Host& mHost;
    Worker& mWorker;
    FrameFeed& mFeed;
    SceneDocument& mDocument;
    LampTool& mTool;
    QTimer mTimer; ///< joins the changes of one turn of the event loop into one question
    Depth mAskedDepth;
};

} // namespace lampblack
