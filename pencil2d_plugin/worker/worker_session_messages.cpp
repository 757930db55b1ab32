// How a session handles the messages of the worker.
#include "worker/worker_session.h"

#include <limits>

namespace lampblack
{

namespace
{

/// Whether the job ends with this error, without a "done" message.
bool endsJob(const protocol::Error& error)
{
    static const QStringList codes = {QStringLiteral("no_scene"), QStringLiteral("unknown_frame"),
                                      QStringLiteral("too_many_jobs"), QStringLiteral("stale_request")};
    return error.about == QLatin1String("render") || codes.contains(error.code);
}

} // namespace

void WorkerSession::handle(const protocol::Welcome& welcome)
{
    constexpr int MinorWithOverlaps = 2;
    mTellsOverlaps = welcome.minor >= MinorWithOverlaps;
    mSketchesRigs = welcome.capabilities.contains(QStringLiteral("rigs"));
    mTellsNormals = welcome.capabilities.contains(QStringLiteral("normals"));
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
    // A picture that comes late, when the animation has played on, is good for the next time.
    const bool isWanted = mPreview && image.show == mPreview->show &&
                          shown != mFrameStore.frames().constEnd() && image.digest == shown->digest;
    const bool isOurs = image.request <= mRequest && image.revision <= mRevision &&
                        !mJobRevisions.contains(image.revision) && !picture.isNull();
    const ImageRank rank{image.request, isWanted ? shown->drawing : 0, image.revision, image.pass};
    if (!isWanted || !isOurs || !(mImageRanks.value(image.frame) < rank))
    {
        return;
    }
    mImageRanks.insert(image.frame, rank);
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

void WorkerSession::handle(const protocol::Rigs& rigs, const QImage& pictures)
{
    if (!isAnswer(mRigRequests, rigs.frame, rigs.request, rigs.digest))
    {
        return;
    }
    QVector<RigSketch> sketches;
    const int side = pictures.width();
    for (int place = 0; place < rigs.names.size() && (place + 1) * side <= pictures.height(); ++place)
    {
        sketches.append({rigs.names[place], pictures.copy(0, place * side, side, side)});
    }
    Q_EMIT rigsArrived(rigs.frame, sketches);
}

void WorkerSession::handle(const protocol::Normals& normals, const QImage& picture)
{
    if (isAnswer(mNormalsRequests, normals.frame, normals.request, normals.digest))
    {
        Q_EMIT normalsArrived(normals.frame, picture);
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
    if (!status.card.isEmpty() && (!before || before->card != status.card))
    {
        Q_EMIT cardFound(status.card);
    }
}

void WorkerSession::handle(const protocol::Error& error)
{
    const QString details = QStringLiteral("%1: %2").arg(error.code, error.details);
    if (error.code == QLatin1String("version_mismatch"))
    {
        source().giveUp(source().versionMismatch(details));
        return;
    }
    if (error.code == QLatin1String("not_greeted"))
    {
        if (mGreeted)
        {
            source().restart(QStringLiteral("It forgot us."));
        }
        return;
    }
    if (error.code == QLatin1String("header_too_large"))
    {
        Q_EMIT problem({tr("Too many colours have a material of their own."),
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
    if (error.code == QLatin1String("nothing_drawn"))
    {
        Q_EMIT problem({tr("Nothing is drawn here yet."), tr("Draw something: it will be lit."), details,
                        UserError::Kind::NothingDrawn, error.frame ? static_cast<int>(*error.frame) : 0});
        return;
    }
    Q_EMIT problem({error.what, error.remedy, details});
    if (error.fatal)
    {
        source().restart(error.what);
    }
}

void WorkerSession::updateState()
{
    State state = State::Ready;
    const State underWay = mWasLost ? State::Restarting : State::Starting;
    if (!source().isRunning())
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
