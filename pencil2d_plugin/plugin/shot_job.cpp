#include "plugin/shot_job.h"

#include <QDir>
#include <QFileInfo>

namespace lampblack
{

ShotJob::ShotJob(Host& host, Worker& worker, FrameFeed& feed, SceneDocument& document, QObject* parent)
    : QObject(parent), mHost(host), mWorker(worker), mFeed(feed), mDocument(document)
{
    connect(&feed, &FrameFeed::freshened, this, &ShotJob::gave);
    connect(&feed, &FrameFeed::failed, this,
            [this](int frame, const UserError& error)
            {
                if (mWaiting.contains(frame))
                    Q_EMIT problem(error);
                gave(frame);
            });
    connect(&worker, &Worker::framesLit, this,
            [this](int lit, int held)
            {
                if (mKind != Kind::Surfaces || !mWaiting.isEmpty())
                    return;
                Q_EMIT progressed(mKind, lit, held, tr("Lighting"));
                if (lit >= held)
                    end(tr("%n frame(s) have their surfaces.", nullptr, mTotal));
            });
    connect(&worker, &Worker::renderProgress, this,
            [this](quint64 job, int, double, int done, int total)
            {
                if (job == mRender && mKind == Kind::Render)
                    Q_EMIT progressed(mKind, done, total, tr("Rendering"));
            });
    connect(&worker, &Worker::renderDone, this,
            [this](quint64 job, const QString& outcome, int done, int total, int failed)
            {
                if (job != mRender || mKind != Kind::Render)
                    return;
                if (outcome == QLatin1String("finished") && failed == 0)
                    end(tr("%1 frames are in %2").arg(done).arg(outputFolder()));
                else
                    end(tr("%1 of %2 frames are in %3").arg(done).arg(total).arg(outputFolder()));
            });
}

QString ShotJob::outputFolder() const
{
    const QFileInfo project(mHost.projectPath());
    if (mHost.projectPath().isEmpty())
        return {};
    return project.absoluteDir().filePath(project.completeBaseName() + QStringLiteral("_lit"));
}

void ShotJob::generateSurfaces()
{
    if (mKind == Kind::None)
        begin(Kind::Surfaces);
}

void ShotJob::renderAll()
{
    if (mKind != Kind::None)
        return;
    if (outputFolder().isEmpty())
        Q_EMIT problem({tr("The project has no file yet, so there is no place for its lit frames."),
                        tr("Save the project, then render."),
                        {}});
    else if (!QDir().mkpath(outputFolder()))
        Q_EMIT problem({tr("The folder for the lit frames cannot be made."),
                        tr("Save the project where you may write."), outputFolder()});
    else
        begin(Kind::Render);
}

void ShotJob::cancel()
{
    if (mKind == Kind::None)
        return;
    mFeed.stopWanting();
    if (mRender != 0)
        mWorker.cancelRender(mRender);
    end(tr("Cancelled."));
}

void ShotJob::begin(Kind kind)
{
    mKind = kind;
    mRender = 0;
    mTotal = mHost.frameCount();
    for (int frame = 1; frame <= mTotal; ++frame)
        mWaiting.insert(frame);
    Q_EMIT progressed(mKind, 0, mTotal, tr("Reading the drawings"));
    mFeed.wantAll(1, mTotal);
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
    if (mKind != Kind::Render)
        return;
    const QString name = QFileInfo(mHost.projectPath()).completeBaseName();
    // A per cent sign would be read as part of the pattern.
    const QString pattern =
        QString(name).replace(QLatin1Char('%'), QLatin1Char('_')) + QStringLiteral(".%04d.png");
    mRender = mWorker.render(QStringLiteral("1-%1").arg(mTotal), QDir(outputFolder()).filePath(pattern),
                             mDocument.scene().quality);
}

void ShotJob::end(const QString& said)
{
    const Kind kind = mKind;
    mKind = Kind::None;
    mWaiting.clear();
    mRender = 0;
    Q_EMIT ended(kind, said);
}

} // namespace lampblack
