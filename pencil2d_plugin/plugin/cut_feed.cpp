#include "plugin/cut_feed.h"

#include <algorithm>
#include <cstdlib>

namespace lampblack
{

namespace
{
constexpr int HintReach = 48; ///< frames before and after its own for which a hint counts, as in hints.py
constexpr int MaxHintedFrames = 8; ///< the nearest that are sent
} // namespace

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
    if (!mTool.isActive() || !mFeed.isUpToDate(frame))
        return;
    sendHintedFrames();
    if (!mTool.showsDepth())
        return;
    mAskedDepth = mDocument.scene().depth;
    mWorker.requestOverlaps(frame);
}

void CutFeed::sendHintedFrames()
{
    const int current = mHost.currentFrame();
    QVector<int> frames;
    for (const DepthHint& hint : mDocument.scene().depth.hints)
    {
        if (hint.frame <= mHost.frameCount() && std::abs(hint.frame - current) <= HintReach &&
            !frames.contains(hint.frame))
            frames.append(hint.frame);
    }
    std::sort(frames.begin(), frames.end(),
              [current](int a, int b) { return std::abs(a - current) < std::abs(b - current); });
    frames.resize(std::min(frames.size(), MaxHintedFrames));
    for (const int frame : qAsConst(frames))
    {
        if (!mFeed.isUpToDate(frame))
            mFeed.requestAll(frame, frame);
    }
}

} // namespace lampblack
