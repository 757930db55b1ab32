// "Generate Surfaces" and "Render All Frames": jobs for the whole animation.
#pragma once

#include "host/host.h"
#include "plugin/frame_feed.h"
#include "plugin/lit_layer.h"
#include "plugin/saved_project.h"
#include "worker/worker.h"

#include <QSet>

namespace lampblack
{

/// How frames are rendered.
struct RenderChoices
{
    bool hidesSources = false; ///< hide the lit layers if the result layer covers the whole animation
    ApartKind apart = ApartKind::None;
};

/// One job at a time. First all its frames are sent to the worker, a few whenever the artist is idle. Then
/// the worker prepares and lights them, or renders them into files, which become the result layer.
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

    Kind runningKind() const { return mKind; }

    void generateSurfaces();

    /// Render into "<project>_lit/<project>.0001.png" and so on, beside the project, then deliver the files
    /// as the result layer, or as layers apart. EXR files become no layer. A saved project is rendered from
    /// its file, just as the command line does it; with unsaved changes, the drawings are. Files that are up
    /// to date are not rendered again.
    void render(FrameRange range, const RenderChoices& choices);
    void renderFrames(const QVector<int>& frames, const RenderChoices& choices);

    void cancel();

    /// Where render() writes; empty while the project has no file.
    QString outputFolder() const;
    QString framePath(int frame) const { return framePath(frame, QStringLiteral("png")); }

Q_SIGNALS:
    void progressChanged(lampblack::ShotJob::Kind kind, int done, int total, const QString& doing);
    void finished(lampblack::ShotJob::Kind kind, const QString& message);
    void problem(const lampblack::UserError& error);
    /// These frames are in the result layer, lit under this scene.
    void framesDelivered(const QSet<int>& frames, const lampblack::Scene& scene);

private:
    void connectWorker();
    void begin(Kind kind, const QVector<int>& frames, bool sendDrawings);
    void onFrameSent(int frame);
    void onAllFramesSent();
    void onRenderDone(const QString& outcome);
    void deliverLayer();
    void reportMissing();
    void finishWithFiles();
    void finish(const QString& message);
    QString outputPattern(const QString& suffix) const;
    QString framePath(int frame, const QString& suffix) const;
    QString suffix() const; ///< of the files of this job

    Host& mHost;
    Worker& mWorker;
    FrameFeed& mFeed;
    LitLayer& mLayer;
    SceneDocument& mDocument;
    SavedProject mSaved;
    Kind mKind = Kind::None;
    QVector<int> mFrames; ///< frames of this job
    QSet<int> mUnsent;    ///< frames that the worker does not have yet
    int mTotal = 0;
    quint64 mRenderJob = 0;
    QSet<int> mUpToDate; ///< frames whose files show the current drawings under mScene
    QSet<int> mRendered; ///< frames whose files exist for this job
    QSet<int> mRedrawn;  ///< of those, frames that may show another drawing
    QSet<int> mOutdated; ///< frames whose drawings changed during this job
    Scene mScene;        ///< the scene of the last render job
    QStringList mErrors;
    RenderChoices mChoices;
    bool mDeliveringLayer = false;
};

} // namespace lampblack

Q_DECLARE_METATYPE(lampblack::ShotJob::Kind)
