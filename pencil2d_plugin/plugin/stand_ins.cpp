#include "plugin/stand_ins.h"

#include "scene/layer_roles.h"
#include "scene/timeline.h"

#include <algorithm>

namespace lampblack
{

namespace
{
constexpr int MaxKiB = 128 * 1024;
constexpr int MaxNormalsKiB = 32 * 1024;

/// Where parts are in front of others, in the image that a camera makes of the canvas.
QVector<InnerEdge> innerEdges(const QVector<Overlap>& overlaps, const QTransform& canvasToImage)
{
    QVector<InnerEdge> edges;
    for (const Overlap& overlap : overlaps)
    {
        if (overlap.front == FrontSide::Joined)
            continue;
        InnerEdge edge;
        for (const OverlapPoint& point : overlap.points)
            edge.line.append(canvasToImage.map(QPointF(point.x, point.y)));
        const bool isMirrored = canvasToImage.determinant() < 0;
        edge.isFrontLeft = (overlap.front == FrontSide::Left) != isMirrored;
        edges.append(edge);
    }
    return edges;
}
} // namespace

StandIns::StandIns(Host& host, Worker& worker, FrameFeed& feed, UnlitLayers& unlit, SceneDocument& document,
                   QObject* parent)
    : QObject(parent), mHost(host), mWorker(worker), mFeed(feed), mUnlit(unlit), mDocument(document),
      mKept(MaxKiB), mNormals(MaxNormalsKiB)
{
    const auto forget = [this]
    {
        mKept.clear();
        mNormals.clear();
        mOverlaps.clear();
        mAsked.clear();
    };
    connect(&feed, &FrameFeed::frameOutdated, this,
            [this](int frame)
            {
                mKept.remove(frame);
                mNormals.remove(frame);
                mOverlaps.remove(frame);
                mAsked.remove(frame);
            });
    connect(&host, &Host::projectOpened, this, forget);
    connect(&host, &Host::layersChanged, this, forget);
    connect(&document, &SceneDocument::sceneChanged, this,
            [this, forget]
            {
                if (mDocument.scene().depth == mDepth)
                    return;
                mDepth = mDocument.scene().depth;
                forget();
            });
    connectSurface();
}

void StandIns::connectSurface()
{
    // A drawing that is lit has its surface: the answer costs the worker next to nothing.
    connect(&mWorker, &Worker::imageArrived, this,
            [this](const PreviewImage& image)
            {
                if (image.show != Show::Lit || !image.converged || mAsked.contains(image.frame))
                    return;
                mAsked.insert(image.frame);
                mWorker.requestNormals(image.frame);
                mWorker.requestOverlaps(image.frame);
            });
    connect(&mWorker, &Worker::overlapsArrived, this,
            [this](int frame, const QVector<Overlap>& overlaps)
            {
                mOverlaps.insert(frame, overlaps);
                mKept.remove(frame);
            });
    connect(&mWorker, &Worker::normalsArrived, this,
            [this](int frame, const QImage& picture)
            {
                mNormals.insert(frame, new QImage(picture), int(picture.sizeInBytes() / 1024) + 1);
                mKept.remove(frame);
            });
}

std::optional<StandIn> StandIns::current()
{
    const int frame = mHost.currentFrame();
    const FrameExport exported = mUnlit.isLoaded(frame) ? mFeed.lastExport(frame) : FrameExport();
    const std::optional<QTransform> view = mHost.canvasToWidget();
    if (!view)
        return std::nullopt;
    const Scene scene = sceneAt(mDocument.scene(), frame);
    Kept* kept = mKept.object(frame);
    const bool fits = kept != nullptr &&
                      (exported.image.isNull() ? kept->standIn.isWhole && kept->standIn.canvasToImage == *view
                                               : !kept->standIn.isWhole);
    if (fits && kept->scene == scene)
        return kept->standIn;

    Kept made;
    if (fits)
    {
        made.source = kept->source;
        made.shape = kept->shape;
        made.edges = kept->edges;
    }
    else
    {
        const std::optional<FrameExport> source =
            exported.image.isNull() ? seenOnCanvas() : std::optional<FrameExport>(exported);
        if (!source)
            return std::nullopt;
        made.source = *source;
        made.shape = inflateFigure(made.source.image);
        const QImage* normals = exported.image.isNull() ? nullptr : mNormals.object(frame);
        if (normals != nullptr)
            takeNormals(made.shape, *normals);
    }
    made.scene = scene;
    made.standIn.isWhole = exported.image.isNull();
    made.standIn.canvasToImage = made.source.canvasToImage;
    made.standIn.drawn = made.source;
    made.standIn.picture.frame = frame;
    if (!made.shape.isEmpty())
    {
        if (scene.rim && made.edges.isEmpty())
        {
            const bool isRead = !exported.image.isNull();
            const QVector<Overlap> overlaps = isRead ? mOverlaps.value(frame) : QVector<Overlap>();
            made.edges = edgesOf(made.source.image, innerEdges(overlaps, made.source.canvasToImage));
        }
        const QTransform& camera = made.source.canvasToImage;
        made.standIn.picture.picture =
            shadedDrawing(made.source.image, made.shape, lightOn(made.shape, scene, camera),
                          InstantRim(scene, made.edges, camera), scene);
        made.standIn.picture.crop = QRectF(QPointF(), QSizeF(made.source.image.size()));
    }
    const qint64 bytes = made.standIn.picture.picture.sizeInBytes() + made.source.image.sizeInBytes();
    const StandIn standIn = made.standIn;
    mKept.insert(frame, new Kept(made), int(bytes / 1024) + 1);
    return standIn;
}

std::optional<FrameExport> StandIns::seenOnCanvas() const
{
    QWidget* canvas = mHost.canvas();
    const std::optional<QTransform> view = mHost.canvasToWidget();
    if (canvas == nullptr || !view || showsResult() || canvas->size().isEmpty())
        return std::nullopt;
    QImage image(canvas->size(), QImage::Format_ARGB32_Premultiplied);
    image.fill(Qt::transparent);
    canvas->render(&image, QPoint(), QRegion(), QWidget::RenderFlags());
    return FrameExport{mHost.currentFrame(), image, *view, {}};
}

bool StandIns::showsResult() const
{
    const QVector<Layer> layers = mHost.layers();
    const LayerRoles roles = mDocument.layerRoles();
    return std::any_of(layers.begin(), layers.end(),
                       [&](const Layer& layer) { return layer.visible && isResult(layer.name, roles); });
}

} // namespace lampblack
