// What a session says to its worker, and what it makes of the answers.
#include "worker/worker_session.h"

#include "protocol/planes.h"
#include "worker/frame_list.h"

#include <limits>

namespace lampblack
{

namespace
{

constexpr int MostListLength = 1024;

protocol::Show wireShow(Show show)
{
    switch (show)
    {
    case Show::Normals:
        return protocol::Show::Normals;
    case Show::Relief:
        return protocol::Show::Relief;
    case Show::Lit:
        break;
    }
    return protocol::Show::Lit;
}

/// Errors after which a job has no other end.
bool endsJob(const protocol::Error& error)
{
    static const QStringList codes = {QStringLiteral("no_scene"), QStringLiteral("unknown_frame"),
                                      QStringLiteral("too_many_jobs"), QStringLiteral("stale_request")};
    return error.about == QLatin1String("render") || codes.contains(error.code);
}

} // namespace

void WorkerSession::send(const protocol::Message& message, const QImage& pixels)
{
    if (mGreeted && !mLink->send({message, pixels}))
    {
        mProcess.replace(QStringLiteral("It did not read any more."));
    }
}

void WorkerSession::announceAll()
{
    const QList<int> frames = mBook.frames().keys();
    for (const int frame : frames)
    {
        announce(frame);
    }
    sendScene();
    if (mLook)
    {
        mLook->request = 0;
    }
    for (quint64& request : mPalettes)
    {
        request = 0;
    }
    sendLook();
    sendPalettes();
    sendJobs();
}

void WorkerSession::announce(int frame)
{
    const ShownFrame shown = mBook.frames().value(frame);
    send(protocol::PutFrame{frame, shown.digest, shown.camera, {}});
}

void WorkerSession::sendPlanes(int frame, const QByteArray& digest)
{
    const QImage pixels = mBook.drawing(digest);
    if (pixels.isNull())
    {
        mOwed.insert(digest);
        Q_EMIT frameWanted(frame);
        return;
    }
    mOwed.remove(digest);
    const protocol::Plane plane = protocol::viewOf(protocol::Role::Pixels, pixels).plane;
    send(protocol::PutFrame{frame, digest, mBook.frames().value(frame).camera, {plane}}, pixels);
}

void WorkerSession::sendScene()
{
    if (mScene)
    {
        mSceneRevisions.insert(++mRevision);
        send(protocol::SetScene{mRevision, *mScene});
    }
}

void WorkerSession::sendLook()
{
    const bool lit = mLook && mLook->show == Show::Lit;
    if (!mGreeted || !mLook || !mBook.frames().contains(mLook->frame) || (lit && !mScene))
    {
        return;
    }
    mLook->request = ++mRequest;
    const QSize size = mLook->size;
    if (lit)
    {
        send(protocol::Preview{mRequest, mLook->frame, mLook->crop, size.width(), size.height()});
    }
    else
    {
        send(protocol::View{mRequest, mLook->frame, wireShow(mLook->show), mLook->crop, size.width(),
                            size.height()});
    }
}

void WorkerSession::sendPalettes()
{
    for (auto wanted = mPalettes.begin(); mGreeted && wanted != mPalettes.end(); ++wanted)
    {
        if (wanted.value() == 0 && mBook.frames().contains(wanted.key()))
        {
            wanted.value() = ++mRequest;
            send(protocol::GetPalette{mRequest, wanted.key()});
        }
    }
}

void WorkerSession::sendJobs()
{
    const QList<quint64> numbers = mJobs.jobs().keys();
    for (const quint64 number : numbers)
    {
        RenderJob& job = mJobs.jobs()[number];
        if (!mGreeted || job.request != 0 || !mBook.isSettled(job.lastPut))
        {
            continue;
        }
        const QString frames = formatFrames(job.frames);
        if (frames.isEmpty() || frames.size() > MostListLength)
        {
            mJobs.end(number, frames.isEmpty() ? protocol::Outcome::Finished : protocol::Outcome::Failed);
            continue;
        }
        const bool other = job.scene && job.scene != mScene;
        if (other)
        {
            mJobRevisions.insert(++mRevision);
            send(protocol::SetScene{mRevision, *job.scene});
        }
        job.request = ++mRequest;
        ++job.asked;
        send(protocol::Render{mRequest, frames, job.output, job.quality, job.keepFinished});
        if (other)
        {
            sendScene();
        }
    }
}

void WorkerSession::frameShown(int frame, bool changed)
{
    const QByteArray digest = mBook.frames().value(frame).digest;
    if (mOwed.contains(digest))
    {
        sendPlanes(frame, digest);
    }
    else if (changed)
    {
        announce(frame);
    }
    if (mLook && mLook->frame == frame && mLook->request == 0)
    {
        sendLook();
    }
    sendPalettes();
    sendJobs();
}

void WorkerSession::handle(const protocol::Welcome& /*welcome*/)
{
    mGreeted = true;
    announceAll();
    updateState();
}

void WorkerSession::handle(const protocol::NeedFrame& need)
{
    if (mBook.frames().value(need.frame).digest == need.digest)
    {
        sendPlanes(need.frame, need.digest);
    }
}

void WorkerSession::handle(const protocol::Image& image, const QImage& picture)
{
    const auto shown = mBook.frames().constFind(image.frame);
    const bool wanted = mLook && image.frame == mLook->frame && image.show == wireShow(mLook->show) &&
                        shown != mBook.frames().constEnd() && image.digest == shown->digest;
    const bool ours = image.request <= mRequest && image.revision <= mRevision &&
                      !mJobRevisions.contains(image.revision) && !picture.isNull();
    const ImageRank rank{image.request, wanted ? shown->drawing : 0, image.revision, image.pass};
    if (!wanted || !ours || !(mShown < rank))
    {
        return;
    }
    mShown = rank;
    const int pass = static_cast<int>(qMin(image.pass, quint64(std::numeric_limits<int>::max())));
    Q_EMIT imageArrived(
        {image.frame, mLook->show, image.crop, picture, image.digest, image.revision, pass, image.converged});
}

void WorkerSession::handle(const protocol::Palette& palette)
{
    if (mPalettes.value(palette.frame) != palette.request)
    {
        return;
    }
    if (mBook.frames().value(palette.frame).digest != palette.digest)
    {
        mPalettes[palette.frame] = 0; // redrawn meanwhile
        sendPalettes();
        return;
    }
    mPalettes.remove(palette.frame);
    QVector<Swatch> swatches;
    for (const protocol::Swatch& swatch : palette.swatches)
    {
        swatches.append({swatch.colour, static_cast<qint64>(swatch.pixels)});
    }
    Q_EMIT paletteArrived(palette.frame, swatches);
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
            mProcess.replace(QStringLiteral("It forgot us."));
        }
        return;
    }
    if (error.code == QLatin1String("header_too_large"))
    {
        Q_EMIT problem({tr("More colours have a material of their own than can be lit at once."),
                        tr("Give fewer colours a material of their own."), details});
        return;
    }
    const bool ofLook = mLook && error.request && *error.request == mLook->request;
    const bool expected =
        error.code == QLatin1String("unknown_frame") || error.code == QLatin1String("no_scene");
    // These right themselves: what is missing is on its way, or the state tells of it.
    if ((ofLook && expected) || error.code == QLatin1String("render_restarted"))
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
        mProcess.replace(error.what);
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
