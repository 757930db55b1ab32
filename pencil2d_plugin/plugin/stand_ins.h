// Pictures that stand in for lit ones until these come: instant shadings of frames.
#pragma once

#include "host/host.h"
#include "plugin/frame_feed.h"
#include "plugin/unlit_layers.h"
#include "scene/scene_document.h"
#include "tool/canvas/instant_shading.h"
#include "worker/worker.h"

#include <QCache>
#include <QMap>
#include <QSet>

#include <optional>

namespace lampblack
{

struct StandIn
{
    PreviewImage picture; ///< null: there is nothing to light
    QTransform canvasToImage;
    FrameExport drawn;    ///< that it was made from
    bool isWhole = false; ///< with everything that is seen, not the lit layers alone
};

/// Shades what a frame shows: its lit layers if they have been read, otherwise what the canvas shows at this
/// moment. A drawing that was lit before has the normals and the overlaps of its real surface, others the
/// guess at it. Shapes and pictures are kept while they fit. Takes some milliseconds, in the UI thread.
class StandIns : public QObject
{
    Q_OBJECT

public:
    StandIns(Host& host, Worker& worker, FrameFeed& feed, UnlitLayers& unlit, SceneDocument& document,
             QObject* parent = nullptr);

    /// For the current frame, under the scene as it is now. No value if it cannot be told what is drawn.
    std::optional<StandIn> current();

    /// Whether the canvas shows frames that are lit already.
    bool showsResult() const;

private:
    struct Kept
    {
        FrameExport source;
        InstantShape shape;
        InstantEdges edges; ///< empty until a scene has a rim
        Scene scene;        ///< of `standIn`
        StandIn standIn;
    };

    std::optional<FrameExport> seenOnCanvas() const;
    void connectSurface();

    Host& mHost;
    Worker& mWorker;
    FrameFeed& mFeed;
    UnlitLayers& mUnlit;
    SceneDocument& mDocument;
    QCache<int, Kept> mKept;      ///< by frame, cost in KiB
    QCache<int, QImage> mNormals; ///< by frame, cost in KiB, see Worker::normalsArrived()
    QMap<int, QVector<Overlap>> mOverlaps;
    QSet<int> mAsked; ///< frames whose normals and overlaps are known or asked for
    Depth mDepth;     ///< under which they were
};

} // namespace lampblack
