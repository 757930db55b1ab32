// The worker as the rest of the plugin sees it: one object on Qt's main thread, whatever becomes of
// the process and the socket behind it.
#pragma once

#include "scene/scene.h"
#include "user_error.h"

#include <QImage>
#include <QObject>
#include <QRectF>
#include <QTransform>
#include <QVector>

namespace lampblack
{

enum class Show
{
    Lit,
    Normals,
    Relief
};

/// A picture of a look: it replaces the drawing, ink included, in the whole of its crop.
struct LookImage
{
    int frame = 0;
    Show show = Show::Lit;
    QRectF crop;    ///< view pixels: x right, y down, from the frame's top left corner
    QImage picture; ///< Format_RGBA8888_Premultiplied, covers the crop whatever its size
    QByteArray digest;
    quint64 revision = 0;
    int pass = 0;
    bool converged = false;
};

struct Swatch
{
    QString colour; ///< "#rrggbb"
    qint64 pixels = 0;
};

class Worker : public QObject
{
    Q_OBJECT

public:
    enum class State
    {
        Absent, ///< not installed, or given up: problem() has told why and what to do
        Starting,
        Ready,
        Busy, ///< tracing or rendering
        Restarting
    };
    Q_ENUM(State)

    using QObject::QObject;

    virtual State state() const = 0;

    /// Start the process and connect, if not done yet. stop() ends it; both return at once.
    virtual void start() = 0;
    virtual void stop() = 0;

    /// Frame `frame` shows `pixels` (Format_RGBA8888). Returns at once: the digest is taken in another
    /// thread, then the drawing is kept (shared by digest, bounded; see frameWanted()), sent when asked
    /// for, and announced again by itself after a restart. `camera` takes canvas to view pixels.
    virtual void putFrame(int frame, const QImage& pixels, const QTransform& camera = {}) = 0;
    virtual void dropFrame(int frame) = 0;
    virtual void dropAllFrames() = 0;

    /// Latest wins. Safe to call at any rate: what the worker cannot follow is passed over.
    virtual void setScene(const Scene& scene) = 0;

    /// Of the scene last sent; images tell theirs.
    virtual quint64 revision() const = 0;

    /// Whether a picture kept from before still shows its frame's drawing under the scene as it is.
    virtual bool isCurrent(const LookImage& image) const = 0;

    /// What is in sight: `crop` in view pixels, wanted at `size` device pixels. Ended by stopLooking().
    virtual void look(int frame, Show show, const QRectF& crop, const QSize& size) = 0;
    virtual void stopLooking() = 0;

    virtual void askPalette(int frame) = 0;

    /// Light frames ("1-20x2,25") into files such as /shots/a.%04d.png. Returns the job's number.
    virtual quint64 render(const QString& frames, const QString& output, Quality quality,
                           bool keepFinished = false) = 0;
    virtual void cancelRender(quint64 job) = 0;

Q_SIGNALS:
    void stateChanged(lampblack::Worker::State state);
    void imageArrived(const lampblack::LookImage& image);
    /// The drawing of `frame` is needed and was let go to save memory: export it and put it again.
    void frameWanted(int frame);
    void paletteArrived(int frame, const QVector<lampblack::Swatch>& swatches);
    void framesLit(int lit, int held); ///< of the frames held, those lit under this scene
    void renderProgress(quint64 job, int frame, double share, int done, int total);
    void renderFrameDone(quint64 job, int frame, const QString& path);
    void renderDone(quint64 job, const QString& outcome, int done, int total, int failed);
    void problem(const lampblack::UserError& error);
};

} // namespace lampblack

Q_DECLARE_METATYPE(lampblack::LookImage)
Q_DECLARE_METATYPE(QVector<lampblack::Swatch>)
