// The messages that a session sends to the worker, and how it handles the answers.
#include "worker/worker_session.h"

#include "protocol/planes.h"
#include "worker/frame_list.h"

#include <limits>

namespace lampblack
{

namespace
{

constexpr int MaxListLength = 1024;

/// Whether the job ends with this error, without a "done" message.
bool endsJob(const protocol::Error& error)
{
    static const QStringList codes = {QStringLiteral("no_scene"), QStringLiteral("unknown_frame"),
                                      QStringLiteral("too_many_jobs"), QStringLiteral("stale_request")};
    return error.about == QLatin1String("render") || codes.contains(error.code);
}

} // namespace

void WorkerSession::sendMessage(const protocol::Message& message, const QVector<QImage>& planes)
{
    if (mGreeted && !mLink->send({message, planes}))
    {
        mProcess.restart(QStringLiteral("It did not read any more."));
    }
}

void WorkerSession::sendAll()
{
    const QList<int> frames = mFrameStore.frames().keys();
    for (const int frame : frames)
    {
        announceFrame(frame);
    }
    sendScene();
    if (mPreview)
    {
        mPreview->request = 0;
    }
    for (QMap<int, quint64>* requests : {&mPaletteRequests, &mOverlapRequests})
    {
        for (quint64& request : *requests)
        {
            request = 0;
        }
    }
    sendPreviewRequest();
    sendQuestions();
    sendJobs();
}

void WorkerSession::announceFrame(int frame)
{
    const ShownFrame shown = mFrameStore.frames().value(frame);
    sendMessage(protocol::PutFrame{frame, shown.digest, shown.camera, {}, {}});
}

void WorkerSession::sendPixels(int frame, const QByteArray& digest)
{
    const Drawing drawing = mFrameStore.drawing(digest);
    if (drawing.pixels.isNull())
    {
        mNeeded.insert(digest);
        Q_EMIT frameNeeded(frame);
        return;
    }
    mNeeded.remove(digest);
    protocol::PutFrame put = {frame, digest, mFrameStore.frames().value(frame).camera, {}, {}};
    QVector<QImage> planes;
    const auto add = [&put, &planes](protocol::Role role, const QImage& image)
    {
        put.planes.append(protocol::viewOf(role, image).plane);
        planes.append(image);
    };
    add(protocol::Role::Pixels, drawing.pixels);
    for (const DrawnLayer& layer : drawing.layers)
    {
        add(protocol::Role::Layer, layer.pixels);
        put.layers.append(layer.name);
    }
    sendMessage(put, planes);
}

void WorkerSession::sendScene()
{
    if (mScene)
    {
        mSceneRevisions.insert(++mRevision);
        sendMessage(protocol::SetScene{mRevision, *mScene});
    }
}

void WorkerSession::sendPreviewRequest()
{
    const bool lit = mPreview && mPreview->show == Show::Lit;
    if (!mGreeted || !mPreview || !mFrameStore.frames().contains(mPreview->frame) || (lit && !mScene))
    {
        return;
    }
    mPreview->request = ++mRequest;
    const QSize size = mPreview->size;
    if (lit)
    {
        sendMessage(
            protocol::Preview{mRequest, mPreview->frame, mPreview->crop, size.width(), size.height()});
    }
    else
    {
        sendMessage(protocol::View{mRequest, mPreview->frame, mPreview->show, mPreview->crop, size.width(),
                                   size.height()});
    }
}

void WorkerSession::sendQuestions()
{
    const auto send = [this](QMap<int, quint64>& requests, auto makeQuestion)
    {
        for (auto asked = requests.begin(); asked != requests.end(); ++asked)
        {
            if (asked.value() == 0 && mFrameStore.frames().contains(asked.key()))
            {
                asked.value() = ++mRequest;
                sendMessage(makeQuestion(asked.key()));
            }
        }
    };
    if (!mGreeted)
    {
        return;
    }
    send(mPaletteRequests, [this](int frame) { return protocol::GetPalette{mRequest, frame}; });
    if (mTellsOverlaps)
    {
        send(mOverlapRequests, [this](int frame) { return protocol::GetOverlaps{mRequest, frame}; });
    }
}

void WorkerSession::sendJobs()
{
    const QList<quint64> numbers = mJobs.jobs().keys();
    for (const quint64 number : numbers)
    {
        RenderJob& job = mJobs.jobs()[number];
        if (!mGreeted || job.request != 0 || !mFrameStore.isHashed(job.lastPut))
        {
            continue;
        }
        const QString frames = formatFrames(job.frames);
        if (frames.isEmpty() || frames.size() > MaxListLength)
        {
            mJobs.end(number, frames.isEmpty() ? protocol::Outcome::Finished : protocol::Outcome::Failed);
            continue;
        }
        const bool other = job.scene && job.scene != mScene;
        if (other)
        {
            mJobRevisions.insert(++mRevision);
            sendMessage(protocol::SetScene{mRevision, *job.scene});
        }
        job.request = ++mRequest;
        ++job.asked;
        sendMessage(
            protocol::Render{mRequest, frames, job.output, job.quality, !job.project.isEmpty(), job.project});
        if (other)
        {
            sendScene();
        }
    }
}

void WorkerSession::onFrameHashed(int frame, bool changed)
{
    const QByteArray digest = mFrameStore.frames().value(frame).digest;
    if (mNeeded.contains(digest))
    {
        sendPixels(frame, digest);
    }
    else if (changed)
    {
        announceFrame(frame);
    }
    if (mPreview && mPreview->frame == frame && mPreview->request == 0)
    {
        sendPreviewRequest();
    }
    sendQuestions();
    sendJobs();
}

void WorkerSession::handle(const protocol::Welcome& welcome)
{
    constexpr int MinorWithOverlaps = 2;
    mTellsOverlaps = welcome.minor >= MinorWithOverlaps;
    setTakesLayers(welcome.capabilities.contains(QStringLiteral("layers")));
    mGreeted = true;
    sendAll();
    updateState();
}

void WorkerSession::setTakesLayers(bool takes)
{
    if (std::exchange(mTakesLayers, takes) == takes)
    {
        return;
    }
    const QMap<int, ShownFrame> frames = mFrameStore.frames();
    for (auto shown = frames.begin(); shown != frames.end(); ++shown)
    {
        const Drawing drawing = mFrameStore.drawing(shown->digest);
        mFrameStore.drop(shown.key());
        if (takes || drawing.pixels.isNull())
        {
            Q_EMIT frameNeeded(shown.key());
        }
        else
        {
            putFrame(shown.key(), drawing.pixels, shown->camera);
        }
    }
}

void WorkerSession::handle(const protocol::NeedFrame& need)
{
    if (mFrameStore.frames().value(need.frame).digest == need.digest)
    {
        sendPixels(need.frame, need.digest);
    }
}

void WorkerSession::handle(const protocol::Image& image, const QImage& picture)
{
    const auto shown = mFrameStore.frames().constFind(image.frame);
    const bool isWanted = mPreview && image.frame == mPreview->frame && image.show == mPreview->show &&
                          shown != mFrameStore.frames().constEnd() && image.digest == shown->digest;
    const bool isOurs = image.request <= mRequest && image.revision <= mRevision &&
                        !mJobRevisions.contains(image.revision) && !picture.isNull();
    const ImageRank rank{image.request, isWanted ? shown->drawing : 0, image.revision, image.pass};
    if (!isWanted || !isOurs || !(mShownRank < rank))
    {
        return;
    }
    mShownRank = rank;
    const int pass = static_cast<int>(qMin(image.pass, quint64(std::numeric_limits<int>::max())));
    Q_EMIT imageArrived({image.frame, mPreview->show, image.crop, picture, image.digest, image.revision, pass,
                         image.converged});
}

void WorkerSession::handle(const protocol::Palette& palette)
{
    if (isAnswer(mPaletteRequests, palette.frame, palette.request, palette.digest))
    {
        Q_EMIT paletteArrived(palette.frame, palette.swatches);
    }
}

void WorkerSession::handle(const protocol::Overlaps& overlaps)
{
    if (isAnswer(mOverlapRequests, overlaps.frame, overlaps.request, overlaps.digest))
    {
        Q_EMIT overlapsArrived(overlaps.frame, overlaps.overlaps);
    }
}

bool WorkerSession::isAnswer(QMap<int, quint64>& requests, int frame, quint64 request,
                             const QByteArray& digest)
{
    const auto asked = requests.find(frame);
    if (asked == requests.end() || asked.value() != request)
    {
        return false;
    }
    if (mFrameStore.frames().value(frame).digest != digest)
    {
        asked.value() = 0;
        sendQuestions();
        return false;
    }
    requests.erase(asked);
    return true;
}

void WorkerSession::handle(const protocol::Status& status)
{
    const std::optional<protocol::Status> before = std::exchange(mStatus, status);
    updateState();
    if (!before || before->framesLit != status.framesLit || before->framesHeld != status.framesHeld)
    {
        Q_EMIT framesLit(static_cast<int>(status.framesLit), static_cast<int>(status.framesHeld));
    }
}

void WorkerSession::handle(const protocol::Error& error)
{
    const QString details = QStringLiteral("%1: %2").arg(error.code, error.details);
    if (error.code == QLatin1String("version_mismatch"))
    {
        mProcess.giveUp(versionMismatch(details));
        return;
    }
    if (error.code == QLatin1String("not_greeted"))
    {
        if (mGreeted)
        {
            mProcess.restart(QStringLiteral("It forgot us."));
        }
        return;
    }
    if (error.code == QLatin1String("header_too_large"))
    {
        Q_EMIT problem({tr("More colours have a material of their own than can be lit at once."),
                        tr("Give fewer colours a material of their own."), details});
        return;
    }
    const bool ofPreview = mPreview && error.request && *error.request == mPreview->request;
    const bool expected =
        error.code == QLatin1String("unknown_frame") || error.code == QLatin1String("no_scene");
    // These need no message: the missing frame or scene is being sent, or the state shows the restart.
    if ((ofPreview && expected) || error.code == QLatin1String("render_restarted"))
    {
        return;
    }
    if (error.request && endsJob(error))
    {
        mJobs.endRequest(*error.request, protocol::Outcome::Failed);
    }
    Q_EMIT problem({error.what, error.remedy, details});
    if (error.fatal)
    {
        mProcess.restart(error.what);
    }
}

void WorkerSession::updateState()
{
    State state = State::Ready;
    const State underWay = mWasLost ? State::Restarting : State::Starting;
    if (!mProcess.isRunning())
    {
        state = State::Absent;
    }
    else if (!mGreeted || !mStatus || mStatus->preview == protocol::ChildState::Starting)
    {
        state = underWay;
    }
    else if (mStatus->preview == protocol::ChildState::Restarting ||
             mStatus->job == protocol::ChildState::Restarting)
    {
        state = State::Restarting;
    }
    else if (mStatus->preview == protocol::ChildState::Working ||
             mStatus->job == protocol::ChildState::Working ||
             mStatus->job == protocol::ChildState::Starting || mStatus->jobsWaiting > 0)
    {
        state = State::Busy;
    }
    if (mState != state)
    {
        mState = state;
        Q_EMIT stateChanged(state);
    }
}

} // namespace lampblack
