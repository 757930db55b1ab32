// Keeps the current frame lit on the canvas.
#pragma once

#include "host/host.h"
#include "plugin/frame_feed.h"
#include "plugin/stand_ins.h"
#include "plugin/unlit_layers.h"
#include "tool/lamp_tool.h"
#include "worker/worker.h"

#include <QCache>
#include <QTimer>

namespace lampblack
{

/// Requests the visible crop at device resolution, and passes the pictures that arrive to the tool. Pictures
/// are cached by frame, so that playback is lit.
///
/// The rule: while the lamp shows the light, the canvas is lit. A picture that shows the frame's drawing
/// under the scene as they are is *current*. Without one, one is asked for, again and again; until it comes,
/// the last picture of the drawing stays, or an instant shading stands in for it, and the tool is told that
/// the frame is not lit yet.
class LitView : public QObject
{
    Q_OBJECT

public:
    LitView(Host& host, Worker& worker, FrameFeed& feed, UnlitLayers& unlit, SceneDocument& document,
            LampTool& tool, QObject* parent = nullptr);

    bool eventFilter(QObject* watched, QEvent* event) override;

    /// Whether the canvas shows the current frame's picture, if it is to show one.
    bool isLit() const { return mIsLit; }

    /// Call after the scene was sent to the worker.
    void onSceneSent();

private:
    enum class Shown
    {
        Nothing,
        StandIn,
        Lit ///< a picture of the worker
    };

    void onViewChanged();
    void onFrameChanged(int frame);
    void requestPicture();
    void onImageArrived(const PreviewImage& image);
    void show();
    void showPicture(const PreviewImage& picture);
    bool showStandIn();
    void showNothing();
    void setLit(bool lit);
    void askAgain();
    void forgetPictures();
    bool isShowing() const;
    /// The part of the current frame that is in sight, in view pixels; empty if it is not known.
    QRectF cropInSight() const;

    Host& mHost;
    Worker& mWorker;
    FrameFeed& mFeed;
    UnlitLayers& mUnlit;
    LampTool& mTool;
    StandIns mStandIns;
    QTimer mRequestTimer;                ///< joins the changes of one turn of the event loop into one request
    QTimer mPatience;                    ///< runs while the current frame is not lit
    QCache<int, PreviewImage> mPictures; ///< by frame, cost in KiB
    int mShownFrame = 0;
    Shown mShown = Shown::Nothing;
    bool mIsLit = true;
};

} // namespace lampblack
