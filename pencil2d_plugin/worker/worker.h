// The interface of the worker for the rest of the plugin. It lives in Qt's main thread and outlives the
// process and the socket behind it.
#pragma once

#include "protocol/messages.h"
#include "scene/scene.h"
#include "user_error.h"
#include "worker/drawn_layer.h"

#include <QImage>
#include <QObject>
#include <QRectF>
#include <QTransform>
#include <QVector>

#include <optional>

namespace lampblack
{

using protocol::ApartKind;
using protocol::Overlap;
using protocol::OverlapPoint;
using protocol::Show;
using protocol::Swatch;

/// A rendered picture. In its crop it replaces the whole drawing, ink included.
struct PreviewImage
{
    int frame = 0;
    Show show = Show::Lit;
    QRectF crop;          ///< view pixels: x right, y down, from the frame's top left corner
    QImage picture;       ///< Format_RGBA8888_Premultiplied; any size, stretched over the crop
    QByteArray digest;    ///< digest of the drawing
    quint64 revision = 0; ///< revision of the scene
    int pass = 0;
    bool converged = false;
};

/// A rig of the worker, with a picture of a frame's drawing in its light.
struct RigSketch
{
    QString name;   ///< as in the file of the rig, such as "three-point"
    QImage picture; ///< square, Format_RGBA8888_Premultiplied
};

/// A computer on which somebody has started `lampblack serve --listen`.
struct Computer
{
    QString address; ///< such as 10.0.0.5:7100
    QString key;     ///< file of its public key
    QString ownKey;  ///< file of our secret key

    bool operator==(const Computer& other) const
    {
        return address == other.address && key == other.key && ownKey == other.ownKey;
    }
};

class Worker : public QObject
{
    Q_OBJECT

public:
    enum class State
    {
        Absent, ///< not installed, or given up: problem() was emitted
        Starting,
        Ready,
        Busy, ///< tracing or rendering
        Restarting
    };
    Q_ENUM(State)

    using QObject::QObject;

    virtual State state() const = 0;

    /// Start the process and connect, if it does not run yet. stop() ends it. Both return at once.
    virtual void start() = 0;
    virtual void stop() = 0;

    /// What traces the light: a graphics card if there is a good one, or always the processor.
    enum class Device
    {
        Auto,
        Processor
    };
    /// A process that runs is replaced by one with this device; its jobs begin again.
    virtual void setDevice(Device device) = 0;
    /// Let another computer work, or this one again. Jobs begin again there. Files that a job writes must lie
    /// in folders that both computers see under the same name.
    virtual void setComputer(const std::optional<Computer>& computer) = 0;

    /// Frame `frame` shows `pixels` (Format_RGBA8888), which are `layers` together if these are drawn apart.
    /// `camera` maps canvas to view pixels. Returns at once: the digest is calculated in another thread. The
    /// drawing is announced to the worker, again after each restart, and its pixels are sent when the worker
    /// asks for them. They are kept while there is memory, see frameNeeded().
    virtual void putFrame(int frame, const QImage& pixels, const QTransform& camera = {},
                          const DrawnLayers& layers = {}) = 0;
    virtual void dropFrame(int frame) = 0;
    virtual void dropAllFrames() = 0;

    /// May be called at any rate: scenes that the worker is too slow for are skipped, but never the last.
    virtual void setScene(const Scene& scene) = 0;

    /// Revision of the scene last sent, to compare with PreviewImage::revision.
    virtual quint64 revision() const = 0;

    /// How a picture fits what its frame shows now.
    enum class Fit
    {
        Unknown,    ///< the frame was dropped, or its new drawing has no digest yet
        OldDrawing, ///< the frame shows another drawing now
        OldScene,
        Current
    };
    virtual Fit fit(const PreviewImage& image) const = 0;
    bool isCurrent(const PreviewImage& image) const { return fit(image) == Fit::Current; }

    /// Ask for pictures of `crop` (view pixels) of a frame, `size` device pixels large. imageArrived() is
    /// emitted for each, also after every change of scene or drawing, until cancelPreview() or another
    /// request.
    virtual void requestPreview(int frame, Show show, const QRectF& crop, const QSize& size) = 0;
    virtual void cancelPreview() = 0;

    virtual void requestPalette(int frame) = 0;
    /// Ask where the drawing of a frame overlaps itself, under the current scene.
    virtual void requestOverlaps(int frame) = 0;
    /// Ask for pictures of a frame's drawing, `side` pixels large, in the light of each rig of the worker.
    virtual void requestRigs(int frame, int side) = 0;

    /// Ask for the normals of a frame's drawing, as soon as the worker has them.
    virtual void requestNormals(int frame) = 0;

    /// Render frames ("1-20x2,25") into files such as /shots/a.%04d.png or .exr: of the drawings that were
    /// put, or, with a `project`, of that file. Files of a project that are up to date are kept. `apart` adds
    /// layers for compositing. Returns the job's number.
    virtual quint64 render(const QString& frames, const QString& output, Quality quality,
                           const QString& project = {}, ApartKind apart = ApartKind::None) = 0;
    virtual void cancelRender(quint64 job) = 0;

Q_SIGNALS:
    void stateChanged(lampblack::Worker::State state);
    void imageArrived(const lampblack::PreviewImage& image);
    void drawingKnown(int frame); ///< after putFrame(): fit() knows this drawing now
    /// The worker needs the drawing of `frame`, whose pixels are no longer in memory: call putFrame() again.
    void frameNeeded(int frame);
    void paletteArrived(int frame, const QVector<lampblack::Swatch>& swatches);
    void overlapsArrived(int frame, const QVector<lampblack::Overlap>& overlaps); ///< longest first
    /// `picture`, Format_RGBA8888_Premultiplied, is small and shows the whole drawing, opaque where the
    /// character is. Its colour is (n + 1) / 2: x right, y *up*, z to the viewer.
    void normalsArrived(int frame, const QImage& picture);
    void rigsArrived(int frame, const QVector<lampblack::RigSketch>& rigs);
    void framesLit(int lit,
                   int held); ///< number of frames lit under this scene, and of frames the worker has
    void renderProgress(quint64 job, int frame, double share, int done, int total);
    void renderFrameDone(quint64 job, int frame, const QString& path);
    void renderDone(quint64 job, const QString& outcome, int done, int total, int failed);
    void cardFound(const QString& name); ///< the worker traces on this graphics card
    void problem(const lampblack::UserError& error);
};

} // namespace lampblack

Q_DECLARE_METATYPE(lampblack::PreviewImage)
Q_DECLARE_METATYPE(QVector<lampblack::Swatch>)
Q_DECLARE_METATYPE(QVector<lampblack::Overlap>)
Q_DECLARE_METATYPE(QVector<lampblack::RigSketch>)
