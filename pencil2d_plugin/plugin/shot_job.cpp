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
constexpr int MaxErrors = 40;

/// The same words as on the button.
QString surfacesName()
{
    return ShotJob::tr("Generating surfaces");
}

} // namespace

ShotJob::ShotJob(Host& host, Worker& worker, FrameFeed& feed, LitLayer& layer, SceneDocument& document,
                 QObject* parent)
    : QObject(parent), mHost(host), mWorker(worker), mFeed(feed), mLayer(layer), mDocument(document),
      mSaved(host, document)
{
    connect(&feed, &FrameFeed::frameSent, this, &ShotJob::onFrameSent);
    connect(&feed, &FrameFeed::frameOutdated, this,
            [this](int frame)
            {
                mUpToDate.remove(frame);
                mOutdated.insert(frame);
            });
    connect(&feed, &FrameFeed::frameRedrawn, this, [this](int frame) { mRedrawn.insert(frame); });
    connect(&feed, &FrameFeed::frameFailed, this,
            [this](int frame, const UserError& error)
            {
                if (mUnsent.contains(frame))
                    mErrors.append(error.what);
                onFrameSent(frame);
            });
    connect(&host, &Host::projectOpened, this,
            [this]
            {
                mUpToDate.clear();
                mDeliveringLayer = false;
                cancel();
            });
    connect(&layer, &LitLayer::delivered, this,
            [this]
            {
                if (!mDeliveringLayer)
                    return;
                Q_EMIT framesDelivered(mRendered - mRedrawn, mScene);
                const bool isApart = mChoices.apart == ApartKind::Pencil2d;
                finish((isApart ? tr("%1 lit frames are in the layers \"%2\" and in %3")
                                : tr("%1 lit frames are in the layer \"%2\" and in %3"))
                           .arg(mRendered.size())
                           .arg(isApart ? resultLayer(QStringLiteral("…")) : resultLayer(), outputFolder()));
            });
    connect(&layer, &LitLayer::failed, this,
            [this](const UserError& error)
            {
                if (!mDeliveringLayer)
                    return;
                finishWithFiles();
                Q_EMIT problem(error);
            });
    connectWorker();
}

void ShotJob::connectWorker()
{
    connect(&mWorker, &Worker::framesLit, this,
            [this](int lit, int held)
            {
                if (mKind != Kind::Surfaces || !mUnsent.isEmpty())
                    return;
                // The worker may hold other frames too: those at hand are no part of this job.
                const int left = held - lit;
                Q_EMIT progressChanged(mKind, std::max(0, mTotal - left), mTotal, surfacesName());
                if (left <= 0)
                    finish(tr("%n frame(s) have their surfaces.", nullptr, mTotal));
            });
    connect(&mWorker, &Worker::renderProgress, this,
            [this](quint64 job)
            {
                if (job == mRenderJob && mKind == Kind::Render)
                    Q_EMIT progressChanged(mKind, mRendered.size(), mTotal, tr("Rendering"));
            });
    connect(&mWorker, &Worker::renderFrameDone, this,
            [this](quint64 job, int frame)
            {
                if (job != mRenderJob || mKind != Kind::Render)
                    return;
                mRendered.insert(frame);
                if (!mOutdated.contains(frame))
                    mUpToDate.insert(frame);
            });
    connect(&mWorker, &Worker::problem, this,
            [this](const UserError& error)
            {
                if (mKind == Kind::Render && mErrors.size() < MaxErrors)
                    mErrors.append(error.what + QLatin1Char(' ') + error.details);
            });
    connect(&mWorker, &Worker::renderDone, this,
            [this](quint64 job, const QString& outcome)
            {
                if (job == mRenderJob && mKind == Kind::Render)
                    onRenderDone(outcome);
            });
}

QString ShotJob::outputFolder() const
{
    const QFileInfo project(mHost.projectPath());
    if (mHost.projectPath().isEmpty())
        return {};
    return project.absoluteDir().filePath(project.completeBaseName() + QStringLiteral("_lit"));
}

QString ShotJob::suffix() const
{
    return mChoices.apart == ApartKind::Exr ? QStringLiteral("exr") : QStringLiteral("png");
}

QString ShotJob::outputPattern(const QString& suffix) const
{
    // A percent sign would be read as part of the pattern.
    const QString name =
        QFileInfo(mHost.projectPath()).completeBaseName().replace(QLatin1Char('%'), QLatin1Char('_'));
    return QDir(outputFolder()).filePath(name + QStringLiteral(".%04d.") + suffix);
}

QString ShotJob::framePath(int frame, const QString& suffix) const
{
    constexpr int Digits = 4;
    return outputPattern(suffix).replace(QStringLiteral("%04d"),
                                         QString::number(frame).rightJustified(Digits, QLatin1Char('0')));
}

void ShotJob::generateSurfaces()
{
    if (mKind != Kind::None)
        return;
    QVector<int> frames;
    for (int frame = mHost.firstFrame(); frame <= mHost.frameCount(); ++frame)
        frames.append(frame);
    begin(Kind::Surfaces, frames, true);
}

void ShotJob::render(FrameRange range, const RenderChoices& choices)
{
    QVector<int> frames;
    for (int frame = range.first; frame <= range.last; ++frame)
        frames.append(frame);
    renderFrames(frames, choices);
}

void ShotJob::renderFrames(const QVector<int>& frames, const RenderChoices& choices)
{
    if (mKind != Kind::None || frames.isEmpty())
        return;
    if (outputFolder().isEmpty())
    {
        Q_EMIT problem({tr("The project has no file yet, so there is no folder for its lit frames."),
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
    if (mScene != mDocument.scene() || mChoices.apart != choices.apart)
        mUpToDate.clear();
    mScene = mDocument.scene();
    mChoices = choices;
    const QString project = mSaved.path();
    begin(Kind::Render, frames, project.isEmpty());
    if (!project.isEmpty())
        mRenderJob = mWorker.render(formatFrames(frames), outputPattern(suffix()), mScene.quality, project,
                                    mChoices.apart);
}

void ShotJob::cancel()
{
    // Delivering the layer takes a moment only, and must not be left half done.
    if (mKind == Kind::None || mDeliveringLayer)
        return;
    mFeed.cancelAll();
    if (mRenderJob != 0)
        mWorker.cancelRender(mRenderJob);
    finish(tr("Cancelled."));
}

void ShotJob::begin(Kind kind, const QVector<int>& frames, bool sendDrawings)
{
    mKind = kind;
    mRenderJob = 0;
    mFrames = frames;
    mTotal = frames.size();
    mErrors.clear();
    mRendered.clear();
    mOutdated.clear();
    mRedrawn.clear();
    if (!sendDrawings)
    {
        mUnsent.clear();
        Q_EMIT progressChanged(mKind, 0, mTotal, tr("Rendering"));
        return;
    }
    mUnsent = QSet<int>(frames.begin(), frames.end());
    Q_EMIT progressChanged(mKind, 0, mTotal, tr("Reading the drawings"));
    for (const int frame : frames)
        mFeed.requestAll(frame, frame);
}

void ShotJob::onFrameSent(int frame)
{
    if (mKind == Kind::None || !mUnsent.remove(frame))
        return;
    Q_EMIT progressChanged(mKind, mTotal - mUnsent.size(), mTotal, tr("Reading the drawings"));
    if (mUnsent.isEmpty())
        onAllFramesSent();
}

void ShotJob::onAllFramesSent()
{
    mOutdated.clear();
    mRedrawn.clear();
    if (mKind != Kind::Render)
        return;
    QVector<int> missing;
    for (const int frame : qAsConst(mFrames))
    {
        if (mUpToDate.contains(frame) && QFileInfo::exists(framePath(frame, suffix())))
            mRendered.insert(frame);
        else
            missing.append(frame);
    }
    if (missing.isEmpty())
        deliverLayer();
    else
        mRenderJob = mWorker.render(formatFrames(missing), outputPattern(suffix()), mScene.quality, {},
                                    mChoices.apart);
}

void ShotJob::onRenderDone(const QString& outcome)
{
    mRenderJob = 0;
    if (mRendered.size() < mTotal)
        reportMissing();
    if (outcome == QLatin1String("finished"))
        deliverLayer();
    else
        finishWithFiles();
}

void ShotJob::deliverLayer()
{
    if (mRendered.isEmpty() || !mHost.can(Host::Ability::Deliver) || mChoices.apart == ApartKind::Exr)
    {
        finishWithFiles();
        return;
    }
    mDeliveringLayer = true;
    Q_EMIT progressChanged(mKind, mTotal, mTotal, tr("Making the layer"));
    // A job for a part of the animation keeps the other frames of the layer.
    const bool isApart = mChoices.apart == ApartKind::Pencil2d;
    const bool keepsOthers = mLayer.exists(isApart);
    QMap<int, QString> pictures;
    const int count = mHost.frameCount();
    for (int frame = 1; frame <= count; ++frame)
    {
        if (mRendered.contains(frame) ||
            (keepsOthers && !mFrames.contains(frame) && QFileInfo::exists(framePath(frame))))
            pictures.insert(frame, framePath(frame));
    }
    const QVector<LayerPictures> whole{{resultLayer(), pictures}};
    mLayer.deliver(isApart ? picturesApart(pictures) : whole,
                   mChoices.hidesSources && pictures.size() == count);
}

void ShotJob::reportMissing()
{
    QVector<int> missing;
    std::copy_if(mFrames.begin(), mFrames.end(), std::back_inserter(missing),
                 [this](int frame) { return !mRendered.contains(frame); });
    Q_EMIT problem({tr("%1 of %2 frames could not be lit: %3.")
                        .arg(missing.size())
                        .arg(mTotal)
                        .arg(formatFrames(missing)),
                    tr("The other frames are done. Render again to get the missing frames."),
                    mErrors.join(QLatin1Char('\n'))});
}

void ShotJob::finishWithFiles()
{
    finish(tr("%1 of %2 frames are in %3").arg(mRendered.size()).arg(mTotal).arg(outputFolder()));
}

void ShotJob::finish(const QString& message)
{
    const Kind kind = mKind;
    mKind = Kind::None;
    mUnsent.clear();
    mRenderJob = 0;
    mDeliveringLayer = false;
    Q_EMIT finished(kind, message);
}

} // namespace lampblack
