#include "worker/worker_session.h"

#include "protocol/generated/limits.h"
#include "protocol/planes.h"
#include "worker/frame_list.h"
#include "worker/sendable.h"

#include <QDir>
#include <QFileInfo>

namespace lampblack
{

namespace
{

constexpr int LastFrame = 999999;
constexpr int MaxFrames = 100000;
constexpr int LeastRigSide = 16; ///< of a picture, pixels (SPEC 8, get_rigs)
constexpr int MostRigSide = 256;

} // namespace

WorkerSession::WorkerSession(const Interpreter& interpreter, qint64 bytesKept, QObject* parent)
    : Worker(parent), mProcess(interpreter), mFrameStore(bytesKept)
{
    watch(mProcess);
    connect(&mFrameStore, &FrameStore::frameHashed, this, &WorkerSession::onFrameHashed);
    connect(&mJobs, &RenderJobs::progress, this, &Worker::renderProgress);
    connect(&mJobs, &RenderJobs::frameDone, this, &WorkerSession::onFrameWritten);
    connect(&mJobs, &RenderJobs::ended, this, &Worker::renderDone);
}

WorkerSession::~WorkerSession()
{
    mProcess.stop(); // the process ends while the socket is closed
    delete mLink;
}

WorkerSource& WorkerSession::source()
{
    return mOther != nullptr ? static_cast<WorkerSource&>(*mOther) : mProcess;
}

void WorkerSession::watch(WorkerSource& source)
{
    connect(&source, &WorkerSource::ready, this, &WorkerSession::connectTo);
    connect(&source, &WorkerSource::lost, this, &WorkerSession::onWorkerLost);
    connect(&source, &WorkerSource::gaveUp, this,
            [this](const UserError& error)
            {
                onWorkerLost();
                mJobs.endAll(protocol::Outcome::Failed);
                Q_EMIT problem(error);
            });
}

void WorkerSession::start()
{
    if (!source().isRunning())
    {
        mWasLost = false;
        source().start();
        updateState();
    }
}

void WorkerSession::stop()
{
    source().stop();
    closeLink();
    mJobs.endAll(protocol::Outcome::Cancelled);
    updateState();
}

void WorkerSession::setDevice(Device device)
{
    mProcess.setDevice(device == Device::Processor ? QStringLiteral("cpu") : QStringLiteral("auto"));
    if (mProcess.isRunning())
    {
        mProcess.stop();
        onWorkerLost();
        mProcess.start();
    }
}

void WorkerSession::setComputer(const std::optional<Computer>& computer)
{
    const bool wasRunning = source().isRunning();
    source().stop();
    mOther = computer ? std::make_unique<OtherComputer>(*computer) : nullptr;
    if (mOther != nullptr)
    {
        watch(*mOther);
    }
    if (wasRunning)
    {
        onWorkerLost();
        source().start();
    }
}

void WorkerSession::putFrame(int frame, const QImage& pixels, const QTransform& camera,
                             const DrawnLayers& layers)
{
    const protocol::Limits limits;
    const bool known = mFrameStore.frames().contains(frame);
    if (frame < 0 || frame > LastFrame || (!known && mFrameStore.frames().size() >= MaxFrames))
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
    mFrameStore.put(frame, {pixels, mTakesLayers ? sendable(layers, pixels.size()) : DrawnLayers()}, camera);
}

void WorkerSession::dropFrame(int frame)
{
    const bool known = mFrameStore.frames().contains(frame);
    mFrameStore.drop(frame);
    for (QMap<int, quint64>* requests : questions())
    {
        requests->remove(frame);
    }
    if (known)
    {
        sendMessage(protocol::DropFrame{frame});
    }
}

void WorkerSession::dropAllFrames()
{
    const QList<int> frames = mFrameStore.frames().keys();
    mFrameStore.clear();
    for (QMap<int, quint64>* requests : questions())
    {
        requests->clear();
    }
    mNeeded.clear();
    for (const int frame : frames)
    {
        sendMessage(protocol::DropFrame{frame});
    }
}

void WorkerSession::setScene(const Scene& scene)
{
    if (mScene == scene)
    {
        return;
    }
    const bool first = !mScene;
    if (first || !(mScene->depth == scene.depth))
    {
        mDepthRevision = mRevision + 1;
    }
    mScene = scene;
    mSceneRevisions.clear();
    sendScene();
    if (first)
    {
        sendPreviewRequest();
    }
}

Worker::Fit WorkerSession::fit(const PreviewImage& image) const
{
    const auto shown = mFrameStore.frames().constFind(image.frame);
    if (shown == mFrameStore.frames().constEnd() || mFrameStore.isPending(image.frame))
    {
        return Fit::Unknown;
    }
    if (shown->digest != image.digest)
    {
        return Fit::OldDrawing;
    }
    const bool isOfScene =
        image.show == Show::Lit ? mSceneRevisions.contains(image.revision) : image.revision >= mDepthRevision;
    return isOfScene ? Fit::Current : Fit::OldScene;
}

void WorkerSession::requestPreview(int frame, Show show, const QRectF& crop, const QSize& size)
{
    if (frame < 0 || frame > LastFrame || !isFinite(crop) || crop.isEmpty() || size.isEmpty())
    {
        cancelPreview();
        return;
    }
    const PreviewRequest wanted{frame, show, bounded(crop), bounded(size)};
    if (mPreview && mPreview->request != 0 && mPreview->frame == frame && mPreview->show == show &&
        mPreview->crop == wanted.crop && mPreview->size == wanted.size)
    {
        return;
    }
    mPreview = wanted;
    sendPreviewRequest();
}

void WorkerSession::cancelPreview()
{
    if (mPreview && mPreview->request != 0)
    {
        sendMessage(protocol::Cancel{mPreview->request});
    }
    mPreview.reset();
}

void WorkerSession::requestPalette(int frame)
{
    mPaletteRequests.insert(frame, 0);
    sendQuestions();
}

void WorkerSession::requestOverlaps(int frame)
{
    mOverlapRequests.insert(frame, 0);
    sendQuestions();
}

void WorkerSession::requestRigs(int frame, int side)
{
    mRigSide = qBound(LeastRigSide, side, MostRigSide);
    mRigRequests.insert(frame, 0);
    sendQuestions();
}

void WorkerSession::requestNormals(int frame)
{
    mNormalsRequests.insert(frame, 0);
    sendQuestions();
}

std::array<QMap<int, quint64>*, 4> WorkerSession::questions()
{
    return {&mPaletteRequests, &mOverlapRequests, &mRigRequests, &mNormalsRequests};
}

quint64 WorkerSession::render(const QString& frames, const QString& output, Quality quality,
                              const QString& project, ApartKind apart)
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
    if (!source().isRunning())
    {
        return refuseJob({tr("Nothing was rendered: the renderer is not running."),
                          tr("Start Pencil2D again, then render again."), QString()});
    }
    RenderJob job;
    job.frames = *list;
    job.output = output;
    job.quality = quality;
    job.project = project;
    job.apart = apart;
    job.scene = mScene;
    job.lastPut = mFrameStore.lastPut();
    job.total = list->size();
    const quint64 number = mJobs.add(job);
    // Later, when the caller knows the number.
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
        sendMessage(protocol::Cancel{found->request});
    }
    else
    {
        QMetaObject::invokeMethod(
            this, [this, job] { mJobs.end(job, protocol::Outcome::Cancelled); }, Qt::QueuedConnection);
    }
}

void WorkerSession::connectTo(const QString& endpoint)
{
    closeLink();
    try
    {
        mLink = new WorkerLink(endpoint, source().keys(), this);
    }
    catch (const std::exception& error)
    {
        source().restart(QString::fromLocal8Bit(error.what()));
        return;
    }
    connect(mLink, &WorkerLink::messagesArrived, this, &WorkerSession::handleIncoming);
    connect(mLink, &WorkerLink::connectionLost, this,
            [this, link = mLink](WorkerLink::Loss loss)
            {
                if (link == mLink)
                {
                    onLinkLost(loss);
                }
            });
    const QString version = QStringLiteral(LAMPBLACK_VERSION);
    mLink->send({protocol::Hello{protocol::Minor, QStringLiteral("pencil2d"), version, {}}, {}});
}

void WorkerSession::onLinkLost(WorkerLink::Loss loss)
{
    if (mOther != nullptr && loss == WorkerLink::Loss::Refused)
    {
        mOther->giveUp(mOther->refused());
    }
    else if (mOther != nullptr && loss == WorkerLink::Loss::NotReached)
    {
        mOther->giveUp(mOther->notReached());
    }
    else
    {
        source().restart(QStringLiteral("It did not answer any more."));
    }
}

void WorkerSession::onFrameWritten(quint64 job, int frame, const QString& path)
{
    // The folder is read: of a file on a file server, this machine may still remember that it was not there.
    const QFileInfo file(path);
    if (mOther == nullptr || file.dir().entryList(QDir::Files).contains(file.fileName()))
    {
        Q_EMIT renderFrameDone(job, frame, path);
        return;
    }
    Q_EMIT problem(
        {tr("The lit pictures are on the other computer, and not here."),
         tr("Save the project in a folder that both computers see under the same name. Or render on "
            "this computer."),
         path});
    sendMessage(protocol::Cancel{mJobs.jobs().value(job).request});
    mJobs.end(job, protocol::Outcome::Failed);
}

void WorkerSession::closeLink()
{
    mGreeted = false;
    mStatus.reset();
    if (mLink != nullptr)
    {
        std::exchange(mLink, nullptr)->closeLater();
    }
}

void WorkerSession::onWorkerLost()
{
    mWasLost = true;
    closeLink();
    mJobs.forgetRequests();
    updateState();
}

void WorkerSession::handleIncoming()
{
    WorkerLink* const link = mLink;
    if (link == nullptr)
    {
        return;
    }
    const QVector<Incoming> taken = link->takeIncoming();
    for (const Incoming& incoming : taken)
    {
        if (link != mLink)
        {
            return; // a message before has ended the connection
        }
        std::visit(
            [this, &incoming](const auto& message)
            {
                using Kind = std::decay_t<decltype(message)>;
                if constexpr (std::is_same_v<Kind, protocol::Image> || std::is_same_v<Kind, protocol::Rigs> ||
                              std::is_same_v<Kind, protocol::Normals>)
                {
                    handle(message, incoming.picture);
                }
                else if constexpr (std::is_same_v<Kind, protocol::Progress> ||
                                   std::is_same_v<Kind, protocol::FrameDone> ||
                                   std::is_same_v<Kind, protocol::Done>)
                {
                    mJobs.handle(message);
                }
                else if constexpr (std::is_same_v<Kind, protocol::Bye>)
                {
                    source().restart(QStringLiteral("It left: ") + message.reason);
                }
                else if constexpr (std::is_same_v<Kind, protocol::Welcome> ||
                                   std::is_same_v<Kind, protocol::NeedFrame> ||
                                   std::is_same_v<Kind, protocol::Palette> ||
                                   std::is_same_v<Kind, protocol::Overlaps> ||
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
