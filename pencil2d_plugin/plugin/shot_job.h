// "Generate Surfaces" and "Render All Frames": jobs over the whole animation.
#pragma once

#include "host/host.h"
#include "plugin/frame_feed.h"
#include "plugin/lit_layer.h"
#include "worker/worker.h"

#include <QSet>

namespace lampblack
{

/// One job at a time: first every frame is given to the worker, a few each time the artist is idle;
/// then the worker models and lights them all, or renders them into files, which become a layer.
class ShotJob : public QObject
{
    Q_OBJECT

public:
    enum class Kind
    {
        None,
        Surfaces,
        Render
    };

    ShotJob(Host& host, Worker& worker, FrameFeed& feed, LitLayer& layer, SceneDocument& document,
            QObject* parent = nullptr);

    Kind running() const { return mKind; }

    void generateSurfaces();

    /// Into "<project>_lit/<project>.0001.png" and so on, beside the project, and from there into the layer
    /// of results. What a job that was cancelled has made, and what nothing has changed since, is not made
    /// again. The sources are hidden, if so wished, where the layer covers the whole animation.
    void render(FrameRange range, bool hideSources);

    void cancel();

    /// Where render() writes; empty while the project has no file.
    QString outputFolder() const;

Q_SIGNALS:
    void progressed(lampblack::ShotJob::Kind kind, int done, int total, const QString& doing);
    void ended(lampblack::ShotJob::Kind kind, const QString& said);
    void problem(const lampblack::UserError& error);

private:
    void connectWorker();
    void begin(Kind kind, const QVector<int>& frames);
    void gave(int frame);
    void allGiven();
    void rendered(const QString& outcome);
    void makeLayer();
    void tellMissing();
    void endWithFiles();
    void end(const QString& said);
    QString fileOf(int frame) const;
    QString pattern() const;

    Host& mHost;
    Worker& mWorker;
    FrameFeed& mFeed;
    LitLayer& mLayer;
    SceneDocument& mDocument;
    Kind mKind = Kind::None;
    QVector<int> mFrames; ///< of this job
    QSet<int> mWaiting;   ///< frames that the worker was not given yet
    int mTotal = 0;
    quint64 mRender = 0;
    QSet<int> mMade;   ///< frames whose files are of the drawings as they are, under mScene
    QSet<int> mDone;   ///< frames whose files this job has made
    QSet<int> mEdited; ///< frames drawn upon since this job began
    Scene mScene;
    QStringList mFaults;
    bool mHideSources = false;
    bool mMakingLayer = false;
};

} // namespace lampblack

Q_DECLARE_METATYPE(lampblack::ShotJob::Kind)
