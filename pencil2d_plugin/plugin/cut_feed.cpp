#include "plugin/cut_feed.h"

namespace lampblack
{

CutFeed::CutFeed(Host& host, Worker& worker, FrameFeed& feed, SceneDocument& document, LampTool& tool,
                 QObject* parent)
    : QObject(parent), mHost(host), mWorker(worker), mFeed(feed), mDocument(document), mTool(tool)
{
    mTimer.setSingleShot(true);
    mTimer.setInterval(0);
    connect(&mTimer, &QTimer::timeout, this, &CutFeed::ask);
    const auto askSoon = [this]
    {
        mTimer.start();
    };
    connect(&tool, &LampTool::activeChanged, this, askSoon);
    connect(&tool, &LampTool::viewModeChanged, this, askSoon);
    connect(&host, &Host::frameChanged, this, askSoon);
    connect(&feed, &FrameFeed::frameSent, this,
            [this](int frame)
            {
                if (frame == mHost.currentFrame())
                    mTimer.start();
            });
    connect(&document, &SceneDocument::sceneChanged, this,
            [this]
            {
                if (!(mDocument.scene().depth == mAskedDepth))
                    mTimer.start();
            });
    connect(&worker, &Worker::overlapsArrived, this,
            [this](int frame, const QVector<Overlap>& overlaps)
            {
                if (frame == mHost.currentFrame())
                    mTool.setOverlaps(frame, overlaps);
            });
}

void CutFeed::ask()
{
    const int frame = mHost.currentFrame();
    if (!mTool.isActive() || !mTool.showsDepth() || !mFeed.isUpToDate(frame))
        return;
    mAskedDepth = mDocument.scene().depth;
    mWorker.requestOverlaps(frame);
}

} // namespace lampblack
