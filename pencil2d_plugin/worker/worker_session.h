// The worker in its process, over its socket: the one real Worker.
#pragma once

#include "worker/frame_book.h"
#include "worker/look_order.h"
#include "worker/render_jobs.h"
#include "worker/worker.h"
#include "worker/worker_link.h"
#include "worker/worker_process.h"

#include <QSet>

#include <optional>

namespace lampblack
{

/// Keeps what is wanted (frames, scene, look, palettes, jobs) and tells every new worker all of it. Of the UI
/// thread; hashing, encoding and decoding happen elsewhere. Errors come by problem().
class WorkerSession : public Worker
{
    Q_OBJECT

public:
    /// Of drawings about `bytesKept` stay in memory; others are asked for by frameWanted().
    explicit WorkerSession(const Interpreter& interpreter = findInterpreter(), qint64 bytesKept = 512LL << 20,
                           QObject* parent = nullptr);
    /// Waits for the worker's end, at most 2 s: for the program's exit.
    ~WorkerSession() override;

    State state() const override { return mState; }
    void start() override;
    void stop() override;
    void putFrame(int frame, const QImage& pixels, const QTransform& camera = {}) override;
    void dropFrame(int frame) override;
    void dropAllFrames() override;
    void setScene(const Scene& scene) override;
    quint64 revision() const override { return mRevision; }
    bool isCurrent(const LookImage& image) const override;
    void look(int frame, Show show, const QRectF& crop, const QSize& size) override;
    void stopLooking() override;
    void askPalette(int frame) override;
    quint64 render(const QString& frames, const QString& output, Quality quality,
                   bool keepFinished = false) override;
    void cancelRender(quint64 job) override;

    qint64 workerPid() const { return mProcess.pid(); } ///< 0 while there is none

private:
    struct Look
    {
        int frame = 0;
        Show show = Show::Lit;
        QRectF crop;
        QSize size;
        quint64 request = 0; ///< 0 while it is not asked of a worker
    };

    void connectTo(const QString& endpoint);
    void hangUp();
    void workerLost();
    void takeIn();
    void updateState();

    void send(const protocol::Message& message, const QImage& pixels = {});
    void announceAll();
    void announce(int frame);
    void sendPlanes(int frame, const QByteArray& digest);
    void sendScene();
    void sendLook();
    void sendPalettes();
    void sendJobs();
    void frameShown(int frame, bool changed);
    quint64 refuseJob(const UserError& error);

    void handle(const protocol::Welcome& welcome);
    void handle(const protocol::NeedFrame& need);
    void handle(const protocol::Image& image, const QImage& picture);
    void handle(const protocol::Palette& palette);
    void handle(const protocol::Status& status);
    void handle(const protocol::Error& error);

    WorkerProcess mProcess;
    WorkerLink* mLink = nullptr;
    State mState = State::Absent;
    bool mGreeted = false;
    bool mWasLost = false; ///< since start(): the state is restarting rather than starting
    std::optional<protocol::Status> mStatus;
    quint64 mRequest = 0;  ///< the last one, of all workers
    quint64 mRevision = 0; ///< the last one, of all workers

    FrameBook mBook;
    QSet<QByteArray> mOwed; ///< drawings that were asked for when they had been let go
    std::optional<Scene> mScene;
    QSet<quint64> mSceneRevisions; ///< under which mScene was sent
    QSet<quint64> mJobRevisions;   ///< under which the scene of a job was sent that is not mScene
    std::optional<Look> mLook;
    ImageRank mShown;             ///< of the last image that was passed on
    QMap<int, quint64> mPalettes; ///< request by frame, 0 while it is not asked of a worker
    RenderJobs mJobs;
};

} // namespace lampblack
