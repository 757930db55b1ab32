// Which drawing each frame shows, and the pixels of the drawings while there is memory.
#pragma once

#include "worker/drawn_layer.h"

#include <QCache>
#include <QHash>
#include <QImage>
#include <QMap>
#include <QObject>
#include <QThreadPool>
#include <QTransform>

namespace lampblack
{

/// The drawing that a frame shows.
struct ShownFrame
{
    QByteArray digest;   ///< 40 lower-case hexadecimal digits
    QTransform camera;   ///< canvas to view
    quint64 drawing = 0; ///< counts the drawings of all frames, for ImageRank
};

/// What a frame shows.
struct Drawing
{
    QImage pixels; ///< Format_RGBA8888
    DrawnLayers layers;
};

/// To be used from one thread. Digests are calculated in another; frameHashed() is emitted for each.
class FrameStore : public QObject
{
    Q_OBJECT

public:
    explicit FrameStore(qint64 bytesKept = 512LL << 20, QObject* parent = nullptr);
    ~FrameStore() override;

    /// Returns the number of this call, for isHashed(). The frame keeps its old drawing until the digest of
    /// the new one is known.
    quint64 put(int frame, const Drawing& drawing, const QTransform& camera);
    void drop(int frame);
    void clear();

    const QMap<int, ShownFrame>& frames() const { return mFrames; }
    /// Its pixels are null if the drawing was never put or is no longer in memory. The least recently used
    /// are removed first.
    Drawing drawing(const QByteArray& digest);

    quint64 lastPut() const { return mLastPut; }
    /// Whether the digest of the frame's new drawing is not known yet.
    bool isPending(int frame) const { return mNewestPuts.contains(frame); }
    /// Whether the digests of all put() calls up to `number` are known.
    bool isHashed(quint64 number) const;

Q_SIGNALS:
    /// The digest of a drawing is known. `changed`: the frame showed another drawing or camera before.
    void frameHashed(int frame, bool changed);

private:
    void onHashed(quint64 number, int frame, const Drawing& drawing, const QTransform& camera,
                  const QByteArray& digest);

    QMap<int, ShownFrame> mFrames;
    QMap<quint64, int> mPendingPuts;       ///< frame by number of the call
    QHash<int, quint64> mNewestPuts;       ///< number of the newest pending call by frame
    QCache<QByteArray, Drawing> mDrawings; ///< cost in KiB
    quint64 mLastPut = 0;
    quint64 mLastDrawing = 0;
    QThreadPool mHashThread;
};

} // namespace lampblack
