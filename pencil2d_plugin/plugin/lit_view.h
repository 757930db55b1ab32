// Shows the current frame as the worker lights it.
#pragma once

#include "host/host.h"
#include "plugin/frame_feed.h"
#include "plugin/unlit_layers.h"
#include "tool/lamp_tool.h"
#include "worker/worker.h"

#include <QCache>
#include <QTimer>

namespace lampblack
{

/// Requests the visible crop at device resolution, and passes the pictures that arrive to the tool. Pictures
/// are cached by frame, so that playback is lit. A frame is shown as drawn while its picture is out of date
/// or its unlit layers are not loaded.
class LitView : public QObject
{
    Q_OBJECT

public:
    LitView(Host& host, Worker& worker, FrameFeed& feed, UnlitLayers& unlit, LampTool& tool,
            QObject* parent = nullptr);

    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    void onViewChanged();
    void requestPicture();
    void onImageArrived(const PreviewImage& image);
    void showCached(int frame);
    bool isShowing() const;

    Host& mHost;
    Worker& mWorker;
    FrameFeed& mFeed;
    UnlitLayers& mUnlit;
    LampTool& mTool;
    QTimer mRequestTimer;                ///< joins the changes of one turn of the event loop into one request
    QCache<int, PreviewImage> mPictures; ///< by frame, cost in KiB
    int mShownFrame = 0;
};

} // namespace lampblack
