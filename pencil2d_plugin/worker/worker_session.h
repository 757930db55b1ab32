// The Worker that runs in a process of its own and is reached through a socket.
#pragma once

#include "worker/frame_store.h"
#include "worker/image_rank.h"
#include "worker/other_computer.h"
#include "worker/render_jobs.h"
#include "worker/worker.h"
#include "worker/worker_link.h"
#include "worker/worker_process.h"

#include <QSet>

#include <array>
#include <memory>
#include <optional>

namespace lampblack
{

/// Keeps the frames, the scene and the requests, and sends them to every new worker process. To be used from
/// the UI thread; hashing, encoding and decoding happen in other threads. Errors are emitted by problem().
class WorkerSession : public Worker
{
    Q_OBJECT

public:
    /// About `bytesKept` of drawings stay in memory; others are asked for again by frameNeeded().
    explicit WorkerSession(const Interpreter& interpreter = findInterpreter(), qint64 bytesKept = 512LL << 20,
                           QObject* parent = nullptr);
    /// Waits for the worker's end, at most 2 s.
    ~WorkerSession() override;

    State state() const override { return mState; }
    void start() override;
    void stop() override;
    void setDevice(Device device) override;
    void setComputer(const std::optional<Computer>& computer) override;
    void putFrame(int frame, const QImage& pixels, const QTransform& camera = {},
                  const DrawnLayers& layers = {}) override;
    void dropFrame(int frame) override;
    void dropAllFrames() override;
    void setScene(const Scene& scene) override;
    quint64 revision() const override { return mRevision; }
    Fit fit(const PreviewImage& image) const override;
    void requestPreview(int frame, Show show, const QRectF& crop, const QSize& size) override;
    void cancelPreview() override;
    void requestPalette(int frame) override;
    void requestOverlaps(int frame) override;
    void requestRigs(int frame, int side) override;
    void requestNormals(int frame) override;
    quint64 render(const QString& frames, const QString& output, Quality quality, const QString& project = {},
                   ApartKind apart = ApartKind::None) override;
    void cancelRender(quint64 job) override;

    qint64 workerPid() const { return mProcess.pid(); } ///< 0 while there is none

private:
    struct PreviewRequest
    {
        int frame = 0;
        Show show = Show::Lit;
        QRectF crop;
        QSize size;
        quint64 request = 0; ///< 0 while it is not sent
    };

    WorkerSource& source();
    void watch(WorkerSource& source);
    void connectTo(const QString& endpoint);
    void onLinkLost(WorkerLink::Loss loss);
    void onFrameWritten(quint64 job, int frame, const QString& path);
    void closeLink();
    void onWorkerLost();
    void handleIncoming();
    void updateState();

    void sendMessage(const protocol::Message& message, const QVector<QImage>& planes = {});
    void sendAll();
    void announceFrame(int frame);
    void sendPixels(int frame, const QByteArray& digest);
    void sendScene();
    void sendPreviewRequest();
    void sendQuestions();
    void sendJobs();
    void onFrameHashed(int frame, bool changed);
    quint64 refuseJob(const UserError& error);

    void handle(const protocol::Welcome& welcome);
    void handle(const protocol::NeedFrame& need);
    void handle(const protocol::Image& image, const QImage& picture);
    void handle(const protocol::Palette& palette);
    void handle(const protocol::Overlaps& overlaps);
    void handle(const protocol::Rigs& rigs, const QImage& pictures);
    void handle(const protocol::Normals& normals, const QImage& picture);
    /// All that wait for an answer, by kind.
    std::array<QMap<int, quint64>*, 4> questions();
    /// Whether this is the awaited answer about the current drawing. Asks again if the drawing has changed.
    bool isAnswer(QMap<int, quint64>& requests, int frame, quint64 request, const QByteArray& digest);
    void setTakesLayers(bool takes);
    void handle(const protocol::Status& status);
    void handle(const protocol::Error& error);

    WorkerProcess mProcess;
    std::unique_ptr<OtherComputer> mOther; ///< works in place of the process
    WorkerLink* mLink = nullptr;
    State mState = State::Absent;
    bool mGreeted = false;
    bool mWasLost = false; ///< since start(): the state is Restarting, not Starting
    std::optional<protocol::Status> mStatus;
    quint64 mRequest = 0;  ///< the last one sent to any worker process
    quint64 mRevision = 0; ///< the last one sent to any worker process

    FrameStore mFrameStore;
    bool mTakesLayers = true; ///< the worker takes the layers of a drawing apart
    bool mTellsOverlaps = true;
    bool mSketchesRigs = true;
    bool mTellsNormals = true;
    QSet<QByteArray> mNeeded; ///< digests whose pixels the worker waits for
    std::optional<Scene> mScene;
    QSet<quint64> mSceneRevisions; ///< revisions under which mScene was sent
    quint64 mDepthRevision = 0;    ///< the first revision with the depth of mScene
    QSet<quint64> mJobRevisions;   ///< revisions of the scenes of jobs that differ from mScene
    std::optional<PreviewRequest> mPreview;
    QHash<int, ImageRank> mImageRanks;   ///< of the last image that was emitted, by frame
    QMap<int, quint64> mPaletteRequests; ///< request by frame, 0 while it is not sent
    QMap<int, quint64> mOverlapRequests; ///< as well
    QMap<int, quint64> mRigRequests;     ///< as well
    QMap<int, quint64> mNormalsRequests; ///< as well
    int mRigSide = 0;                    ///< of the pictures that were asked for last
    RenderJobs mJobs;
};

} // namespace lampblack
