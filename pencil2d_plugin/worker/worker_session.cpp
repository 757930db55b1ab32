#include "worker/worker_session.h"

#include "protocol/limits.h"
#include "protocol/planes.h"
#include "worker/frame_list.h"

#include <QRegularExpression>

#include <cmath>

namespace lampblack
{

namespace
{

constexpr int LastFrame = 999999;
constexpr int MostFrames = 100000;
constexpr int MostDevicePixels = 4096; // a side of a look
constexpr int MostListLength = 1024;

bool isFinite(const QRectF& rect)
{
    return std::isfinite(rect.x()) && std::isfinite(rect.y()) && std::isfinite(rect.width()) &&
           std::isfinite(rect.height());
}

/// `crop` within what SPEC lets it be.
QRectF bounded(const QRectF& crop)
{
    constexpr double Far = 100000;
    return {qBound(-Far, crop.x(), Far), qBound(-Far, crop.y(), Far), qBound(0.01, crop.width(), Far),
            qBound(0.01, crop.height(), Far)};
}

/// `size` shrunk to what may be wanted, its proportions kept.
QSize bounded(const QSize& size)
{
    const QSize most(MostDevicePixels, MostDevicePixels);
    const bool fits = size.width() <= most.width() && size.height() <= most.height();
    return (fits ? size : size.scaled(most, Qt::KeepAspectRatio)).expandedTo(QSize(1, 1));
}

bool isOutput(const QString& output)
{
    static const QRegularExpression pattern(QStringLiteral("\\A/[^%\\x00-\\x1f\\x7f]*%0[1-9]d\\.png\\z"));
    return output.size() <= MostListLength && pattern.match(output).hasMatch();
}

} // namespace

WorkerSession::WorkerSession(const Interpreter& interpreter, qint64 bytesKept, QObject* parent)
    : Worker(parent), mProcess(interpreter), mBook(bytesKept)
{
    connect(&mProcess, &WorkerProcess::ready, this, &WorkerSession::connectTo);
    connect(&mProcess, &WorkerProcess::lost, this, &WorkerSession::workerLost);
    connect(&mProcess, &WorkerProcess::gaveUp, this,
            [this](const UserError& error)
            {
                workerLost();
                mJobs.endAll(protocol::Outcome::Failed);
                Q_EMIT problem(error);
            });
    connect(&mBook, &FrameBook::shown, this, &WorkerSession::frameShown);
    connect(&mJobs, &RenderJobs::progress, this, &Worker::renderProgress);
    connect(&mJobs, &RenderJobs::frameDone, this, &Worker::renderFrameDone);
    connect(&mJobs, &RenderJobs::ended, this, &Worker::renderDone);
}

WorkerSession::~WorkerSession()
{
    mProcess.stop(); // it ends while the socket is closed
    delete mLink;
}

void WorkerSession::start()
{
    if (!mProcess.isRunning())
    {
        mWasLost = false;
        mProcess.start();
        updateState();
    }
}

void WorkerSession::stop()
{
    mProcess.stop();
    hangUp();
    mJobs.endAll(protocol::Outcome::Cancelled);
    updateState();
}

void WorkerSession::putFrame(int frame, const QImage& pixels, const QTransform& camera)
{
    const protocol::Limits limits;
    const bool known = mBook.frames().contains(frame);
    if (frame < 0 || frame > LastFrame || (!known && mBook.frames().size() >= MostFrames))
    {
        return;
    }
    if (pixels.isNull())
    {
        dropFrame(frame);
        return;
    }
    if (qMax(pixels.width(), pixels.height()) > limits.side ||
        qint64(pixels.width()) * pixels.height() > limits.pixels)
    {
        dropFrame(frame);
        Q_EMIT problem({tr("Frame %1 is too large to be lit.").arg(frame),
                        tr("Use a camera of at most 40 megapixels, and 16,384 pixels a side."),
                        QStringLiteral("%1 x %2 pixels").arg(pixels.width()).arg(pixels.height())});
        return;
    }
    mBook.put(frame, pixels, camera);
}

void WorkerSession::dropFrame(int frame)
{
    const bool known = mBook.frames().contains(frame);
    mBook.drop(frame);
    mPalettes.remove(frame);
    if (known)
    {
        send(protocol::DropFrame{frame});
    }
}

void WorkerSession::dropAllFrames()
{
    const QList<int> frames = mBook.frames().keys();
    mBook.clear();
    mPalettes.clear();
    mOwed.clear();
    for (const int frame : frames)
    {
        send(protocol::DropFrame{frame});
    }
}

void WorkerSession::setScene(const Scene& scene)
{
    if (mScene == scene)
    {
        return;
    }
    const bool first = !mScene;
    mScene = scene;
    mSceneRevisions.clear();
    sendScene();
    if (first)
    {
        sendLook();
    }
}

bool WorkerSession::isCurrent(const LookImage& image) const
{
    const auto shown = mBook.frames().constFind(image.frame);
    return shown != mBook.frames().constEnd() && shown->digest == image.digest &&
           (image.show != Show::Lit || mSceneRevisions.contains(image.revision));
}

void WorkerSession::look(int frame, Show show, const QRectF& crop, const QSize& size)
{
    if (frame < 0 || frame > LastFrame || !isFinite(crop) || crop.isEmpty() || size.isEmpty())
    {
        stopLooking();
        return;
    }
    const Look wanted{frame, show, bounded(crop), bounded(size)};
    if (mLook && mLook->request != 0 && mLook->frame == frame && mLook->show == show &&
        mLook->crop == wanted.crop && mLook->size == wanted.size)
    {
        return;
    }
    mLook = wanted;
    sendLook();
}

void WorkerSession::stopLooking()
{
    if (mLook && mLook->request != 0)
    {
        send(protocol::Cancel{mLook->request});
    }
    mLook.reset();
}

void WorkerSession::askPalette(int frame)
{
    mPalettes.insert(frame, 0);
    sendPalettes();
}

quint64 WorkerSession::render(const QString& frames, const QString& output, Quality quality,
                              bool keepFinished)
{
    const std::optional<QVector<int>> list = parseFrames(frames);
    if (!list)
    {
        return refuseJob({tr("\"%1\" is not a list of frames.").arg(frames.left(80)),
                          tr("Write it like 1-20x2,25."), QString()});
    }
    if (!isOutput(output))
    {
        return refuseJob({tr("Frames cannot be written there."),
                          tr("Choose a folder without a percent sign, and a name such as shot.%04d.png."),
                          output});
    }
    if (!mProcess.isRunning())
    {
        return refuseJob({tr("Nothing was rendered: Lampblack's worker is not running."),
                          tr("Start Pencil2D again, then render again."), QString()});
    }
    RenderJob job;
    job.frames = *list;
    job.output = output;
    job.quality = quality;
    job.keepFinished = keepFinished;
    job.scene = mScene;
    job.lastPut = mBook.lastPut();
    job.total = list->size();
    const quint64 number = mJobs.add(job);
    // After the caller has the number.
    QMetaObject::invokeMethod(this, &WorkerSession::sendJobs, Qt::QueuedConnection);
    return number;
}

quint64 WorkerSession::refuseJob(const UserError& error)
{
    const quint64 number = mJobs.add({});
    QMetaObject::invokeMethod(
        this,
        [this, number, error]
        {
            Q_EMIT problem(error);
            mJobs.end(number, protocol::Outcome::Failed);
        },
        Qt::QueuedConnection);
    return number;
}

void WorkerSession::cancelRender(quint64 job)
{
    const auto found = mJobs.jobs().constFind(job);
    if (found == mJobs.jobs().constEnd())
    {
        return;
    }
    if (found->request != 0)
    {
        send(protocol::Cancel{found->request});
    }
    else
    {
        QMetaObject::invokeMethod(
            this, [this, job] { mJobs.end(job, protocol::Outcome::Cancelled); }, Qt::QueuedConnection);
    }
}

void WorkerSession::connectTo(const QString& endpoint)
{
    hangUp();
    try
    {
        mLink = new WorkerLink(endpoint, this);
    }
    catch (const std::exception& error)
    {
        mProcess.replace(QString::fromLocal8Bit(error.what()));
        return;
    }
    connect(mLink, &WorkerLink::arrived, this, &WorkerSession::takeIn);
    connect(mLink, &WorkerLink::silent, this,
            [this, link = mLink]
            {
                if (link == mLink)
                {
                    mProcess.replace(QStringLiteral("It did not answer any more."));
                }
            });
    const QString version = QStringLiteral(LAMPBLACK_VERSION);
    mLink->send({protocol::Hello{protocol::Minor, QStringLiteral("pencil2d"), version, {}}, {}});
}

void WorkerSession::hangUp()
{
    mGreeted = false;
    mStatus.reset();
    if (mLink != nullptr)
    {
        std::exchange(mLink, nullptr)->retire();
    }
}

void WorkerSession::workerLost()
{
    mWasLost = true;
    hangUp();
    mJobs.forgetRequests();
    updateState();
}

void WorkerSession::takeIn()
{
    WorkerLink* const link = mLink;
    if (link == nullptr)
    {
        return;
    }
    const QVector<Incoming> taken = link->take();
    for (const Incoming& incoming : taken)
    {
        if (link != mLink)
        {
            return; // what one message did ended the connection
        }
        std::visit(
            [this, &incoming](const auto& message)
            {
                using Kind = std::decay_t<decltype(message)>;
                if constexpr (std::is_same_v<Kind, protocol::Image>)
                {
                    handle(message, incoming.picture);
                }
                else if constexpr (std::is_same_v<Kind, protocol::Progress> ||
                                   std::is_same_v<Kind, protocol::FrameDone> ||
                                   std::is_same_v<Kind, protocol::Done>)
                {
                    mJobs.take(message);
                }
                else if constexpr (std::is_same_v<Kind, protocol::Bye>)
                {
                    mProcess.replace(QStringLiteral("It left: ") + message.reason);
                }
                else if constexpr (std::is_same_v<Kind, protocol::Welcome> ||
                                   std::is_same_v<Kind, protocol::NeedFrame> ||
                                   std::is_same_v<Kind, protocol::Palette> ||
                                   std::is_same_v<Kind, protocol::Status> ||
                                   std::is_same_v<Kind, protocol::Error>)
                {
                    handle(message);
                }
            },
            incoming.message);
    }
}

} // namespace lampblack
