// "Generate Surfaces" and "Render All Frames": jobs over the whole animation.
#pragma once

#include "host/host.h"
#include "plugin/frame_feed.h"
#include "worker/worker.h"

#include <QSet>

namespace lampblack
{

/// One job at a time: first every frame is given to the worker, a few each time the artist is idle;
/// then the worker models and lights them all, or renders them into files.
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

    ShotJob(Host& host, Worker& worker, FrameFeed& feed, SceneDocument& document, QObject* parent = nullptr);

    Kind running() const { return mKind; }

    void generateSurfaces();

    /// Into "<project>_lit/<project>.0001.png" and so on, beside the project. Frames that are there
    /// already are made again.
    void renderAll();

    void cancel();

    /// Where renderAll() writes; empty while the project has no file.
    QString outputFolder() const;

Q_SIGNALS:
    void progressed(lampblack::ShotJob::Kind kind, int done, int total, const QString& doing);
    void ended(lampblack::ShotJob::Kind kind, const QString& said);
    void problem(const lampblack::UserError& error);

private:
    void begin(Kind kind);
    void gave(int frame);
    void allGiven();
    void end(const QString& said);

    Host& mHost;
    Worker& mWorker;
    FrameFeed& mFeed;
    SceneDocument& mDocument;
    Kind mKind = Kind::None;
    QSet<int> mWaiting;
    int mTotal = 0;
    quint64 mRender = 0;
};

} // namespace lampblack

Q_DECLARE_METATYPE(lampblack::ShotJob::Kind)
