// What the artist looks at, asked of the worker and shown.
#pragma once

#include "host/host.h"
#include "plugin/frame_feed.h"
#include "plugin/surroundings.h"
#include "tool/lamp_tool.h"
#include "worker/worker.h"

#include <QCache>
#include <QTimer>

namespace lampblack
{

/// Asks for the crop in sight at device resolution, and hands the pictures that come to the tool.
/// Pictures of frames seen before are kept, so that playback shows them lit; what is out of date is
/// shown as drawn, and so is a frame whose surroundings are not known yet.
class LitView : public QObject
{
    Q_OBJECT

public:
    LitView(Host& host, Worker& worker, FrameFeed& feed, Surroundings& around, LampTool& tool,
            QObject* parent = nullptr);

    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    void update();
    void ask();
    void take(const LookImage& image);
    void show(int frame);
    bool isLooking() const;
    Show wanted() const;

    Host& mHost;
    Worker& mWorker;
    FrameFeed& mFeed;
    Surroundings& mAround;
    LampTool& mTool;
    QTimer mSoon;
    QCache<int, LookImage> mKept; ///< by frame, cost in KiB
    int mShownFrame = 0;
};

} // namespace lampblack
