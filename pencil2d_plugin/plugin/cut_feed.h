// What the Depth view and the corrections of depth need of the worker.
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
/// the frame, its drawing, or what the scene says of depth. While the tool is in use, it also sends the
/// frames whose hints count at the current one: the worker carries them over from their drawings.
class CutFeed : public QObject
{
    Q_OBJECT

public:
    CutFeed(Host& host, Worker& worker, FrameFeed& feed, SceneDocument& document, LampTool& tool,
            QObject* parent = nullptr);

private:
    void ask();
    void sendHintedFrames();

    Host& mHost;
    Worker& mWorker;
    FrameFeed& mFeed;
    SceneDocument& mDocument;
    LampTool& mTool;
    QTimer mTimer; ///< joins the changes of one turn of the event loop into one question
    Depth mAskedDepth;
};

} // namespace lampblack
