// Sends drawings from the host to the worker.
#pragma once

#include "host/host.h"
#include "plugin/layers_apart.h"
#include "scene/scene_document.h"
#include "worker/worker.h"

#include <QCache>
#include <QSet>
#include <QTimer>

namespace lampblack
{

/// Exports the current frame and requested frames, and gives them to the worker, layers apart. A frame is
/// exported again only after its drawing has changed.
class FrameFeed : public QObject
{
    Q_OBJECT

public:
    FrameFeed(Host& host, Worker& worker, SceneDocument& document, QObject* parent = nullptr);

    /// While disabled, nothing is exported.
    void setEnabled(bool enabled);
    /// With patience a drawing that has changed is exported when the artist has paused for a moment.
    void setPatient(bool patient) { mRest.setInterval(patient ? RestMs : 0); }
    /// A changed drawing waits for that pause.
    bool isResting() const { return mRest.isActive(); }

    /// Whether the worker has the frame as it is drawn now.
    bool isUpToDate(int frame) const { return mUpToDate.contains(frame); }

    /// The last export of a frame. Its image is null if it is out of date or no longer cached.
    FrameExport lastExport(int frame) const;

    /// Names of the lit layers. Empty if the host cannot name layers: then all visible ones are lit.
    QStringList litLayers() const;

    /// Export frames first..last. frameSent() is emitted for each, at once for those that are up to date.
    void requestAll(int first, int last);
    void cancelAll();

    /// Export the current frame if it is out of date; otherwise frameSent() is emitted.
    void requestCurrent();

Q_SIGNALS:
    void frameSent(int frame);     ///< the worker has the frame as it is drawn now
    void frameOutdated(int frame); ///< the frame's drawing has changed
    /// Its drawing may be another one than before, as that of each frame which holds it; frameSame() follows
    /// if it is not.
    void frameRedrawn(int frame);
    void frameSame(int frame);
    void frameFailed(int frame, const lampblack::UserError& error);

private:
    static constexpr int RestMs = 600;

    /// What a frame showed when it was sent.
    struct Sent
    {
        FrameExport frame;
        QImage light; ///< painted; null where nothing is
    };

    void request(int frame);
    void cancelRequests();
    void onFrameExported(const FrameExport& frame, const DrawnLayers& layers);
    void redraw(const QVector<int>& frames);
    void invalidate(int frame);
    QVector<int> framesLike(int frame) const;
    void invalidateAll();

    Host& mHost;
    Worker& mWorker;
    SceneDocument& mDocument;
    LayersApart mApart;
    bool mEnabled = false;
    QTimer mRest;
    QSet<int> mUpToDate;
    QCache<int, Sent> mExports; ///< cost in KiB
    QHash<int, Sent> mBefore;   ///< of frames that may have been redrawn
};

} // namespace lampblack
