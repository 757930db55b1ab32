#include "plugin/shot_job.h"

#include "scene/layer_roles.h"
#include "worker/frame_list.h"

#include <QDir>
#include <QFileInfo>

#include <algorithm>

namespace lampblack
{

namespace
{
constexpr int MaxFaults = 40;
}

ShotJob::ShotJob(Host& host, Worker& worker, FrameFeed& feed, LitLayer& layer, SceneDocument& document,
                 QObject* parent)
    : QObject(parent), mHost(host), mWorker(worker), mFeed(feed), mLayer(layer), mDocument(document)
{
    connect(&feed, &FrameFeed::freshened, this, &ShotJob::gave);
    connect(&feed, &FrameFeed::staled, this,
            [this](int frame)
            {
                mMade.remove(frame);
                mEdited.insert(frame);
            });
    connect(&feed, &FrameFeed::failed, this,
            [this](int frame, const UserError& error)
            {
                if (mWaiting.contains(frame))
                    mFaults.append(error.what);
                gave(frame);
            });
    connect(&host, &Host::projectOpened, this,
            [this]
            {
                mMade.clear();
                mMakingLayer = false;
                cancel();
            });
    connect(&layer, &LitLayer::delivered, this,
            [this]
            {
                if (mMakingLayer)
                    end(tr("%1 lit frames are in the layer \"%2\" and in %3")
                            .arg(mDone.size())
                            .arg(resultLayer(), outputFolder()));
            });
    connect(&layer, &LitLayer::failed, this,
            [this](const UserError& error)
            {
                if (!mMakingLayer)
                    return;
                endWithFiles();
                Q_EMIT problem(error);
            });
    connectWorker();
}

void ShotJob::connectWorker()
{
    connect(&mWorker, &Worker::framesLit, this,
            [this](int lit, int held)
            {
                if (mKind != Kind::Surfaces || !mWaiting.isEmpty())
                    return;
                Q_EMIT progressed(mKind, lit, held, tr("Lighting"));
                if (lit >= held)
                    end(tr("%n frame(s) have their surfaces.", nullptr, mTotal));
            });
    connect(&mWorker, &Worker::renderProgress, this,
            [this](quint64 job)
            {
                if (job == mRender && mKind == Kind::Render)
                    Q_EMIT progressed(mKind, mDone.size(), mTotal, tr("Rendering"));
            });
    connect(&mWorker, &Worker::renderFrameDone, this,
            [this](quint64 job, int frame)
            {
                if (job != mRender || mKind != Kind::Render)
                    return;
                mDone.insert(frame);
                if (!mEdited.contains(frame))
                    mMade.insert(frame);
            });
    connect(&mWorker, &Worker::problem, this,
            [this](const UserError& error)
            {
                if (mKind == Kind::Render && mFaults.size() < MaxFaults)
                    mFaults.append(error.what + QLatin1Char(' ') + error.details);
            });
    connect(&mWorker, &Worker::renderDone, this,
            [this](quint64 job, const QString& outcome)
            {
                if (job == mRender && mKind == Kind::Render)
                    rendered(outcome);
            });
}

QString ShotJob::outputFolder() const
{
    const QFileInfo project(mHost.projectPath());
    if (mHost.projectPath().isEmpty())
        return {};
    return project.absoluteDir().filePath(project.completeBaseName() + QStringLiteral("_lit"));
}

QString ShotJob::pattern() const
{
    // A per cent sign would be read as part of the pattern.
    const QString name =
        QFileInfo(mHost.projectPath()).completeBaseName().replace(QLatin1Char('%'), QLatin1Char('_'));
    return QDir(outputFolder()).filePath(name + QStringLiteral(".%04d.png"));
}

QString ShotJob::fileOf(int frame) const
{
    constexpr int Digits = 4;
    return pattern().replace(QStringLiteral("%04d"),
                             QString::number(frame).rightJustified(Digits, QLatin1Char('0')));
}

void ShotJob::generateSurfaces()
{
    if (mKind != Kind::None)
        return;
    QVector<int> frames;
    for (int frame = 1; frame <= mHost.frameCount(); ++frame)
        frames.append(frame);
    begin(Kind::Surfaces, frames);
}

void ShotJob::render(FrameRange range, bool hideSources)
{
    if (mKind != Kind::None)
        return;
    if (outputFolder().isEmpty())
    {
        Q_EMIT problem({tr("The project has no file yet, so there is no place for its lit frames."),
                        tr("Save the project, then render."),
                        {}});
        return;
    }
    if (!QDir().mkpath(outputFolder()))
    {
        Q_EMIT problem({tr("The folder for the lit frames cannot be made."),
                        tr("Save the project where you may write."), outputFolder()});
        return;
    }
    if (mScene != mDocument.scene())
        mMade.clear();
    mScene = mDocument.scene();
    mHideSources = hideSources;
    QVector<int> frames;
    for (int frame = range.first; frame <= range.last; ++frame)
        frames.append(frame);
    begin(Kind::Render, frames);
}

void ShotJob::cancel()
{
    // What is left of a job that makes its layer is over in a moment, and best whole.
    if (mKind == Kind::None || mMakingLayer)
        return;
    mFeed.stopWanting();
    if (mRender != 0)
        mWorker.cancelRender(mRender);
    end(tr("Cancelled."));
}

void ShotJob::begin(Kind kind, const QVector<int>& frames)
{
    mKind = kind;
    mRender = 0;
    mFrames = frames;
    mTotal = frames.size();
    mFaults.clear();
    mDone.clear();
    mEdited.clear();
    mWaiting = QSet<int>(frames.begin(), frames.end());
    Q_EMIT progressed(mKind, 0, mTotal, tr("Reading the drawings"));
    mFeed.wantAll(frames.first(), frames.last());
}

void ShotJob::gave(int frame)
{
    if (mKind == Kind::None || !mWaiting.remove(frame))
        return;
    Q_EMIT progressed(mKind, mTotal - mWaiting.size(), mTotal, tr("Reading the drawings"));
    if (mWaiting.isEmpty())
        allGiven();
}

void ShotJob::allGiven()
{
    mEdited.clear();
    if (mKind != Kind::Render)
        return;
    QVector<int> missing;
    for (const int frame : qAsConst(mFrames))
    {
        if (mMade.contains(frame) && QFileInfo::exists(fileOf(frame)))
            mDone.insert(frame);
        else
            missing.append(frame);
    }
    if (missing.isEmpty())
        makeLayer();
    else
        mRender = mWorker.render(formatFrames(missing), pattern(), mScene.quality);
}

void ShotJob::rendered(const QString& outcome)
{
    mRender = 0;
    if (mDone.size() < mTotal)
        tellMissing();
    if (outcome == QLatin1String("finished"))
        makeLayer();
    else
        endWithFiles();
}

void ShotJob::makeLayer()
{
    if (mDone.isEmpty() || !mHost.can(Host::Ability::Deliver))
    {
        endWithFiles();
        return;
    }
    mMakingLayer = true;
    Q_EMIT progressed(mKind, mTotal, mTotal, tr("Making the layer"));
    // A part of the animation goes into what is there already.
    const bool joins = mLayer.isThere();
    QMap<int, QString> pictures;
    const int count = mHost.frameCount();
    for (int frame = 1; frame <= count; ++frame)
    {
        if (mDone.contains(frame) || (joins && !mFrames.contains(frame) && QFileInfo::exists(fileOf(frame))))
            pictures.insert(frame, fileOf(frame));
    }
    mLayer.deliver(pictures, mHideSources && pictures.size() == count);
}

void ShotJob::tellMissing()
{
    QVector<int> missing;
    std::copy_if(mFrames.begin(), mFrames.end(), std::back_inserter(missing),
                 [this](int frame) { return !mDone.contains(frame); });
    Q_EMIT problem({tr("%1 of %2 frames could not be lit: %3.")
                        .arg(missing.size())
                        .arg(mTotal)
                        .arg(formatFrames(missing)),
                    tr("The others are done. Render again for those that are missing."),
                    mFaults.join(QLatin1Char('\n'))});
}

void ShotJob::endWithFiles()
{
    end(tr("%1 of %2 frames are in %3").arg(mDone.size()).arg(mTotal).arg(outputFolder()));
}

void ShotJob::end(const QString& said)
{
    const Kind kind = mKind;
    mKind = Kind::None;
    mWaiting.clear();
    mRender = 0;
    mMakingLayer = false;
    Q_EMIT ended(kind, said);
}

} // namespace lampblack
