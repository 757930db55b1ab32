// The lit layers of a frame, together and each alone.
#pragma once

#include "host/host.h"
#include "worker/drawn_layer.h"

#include <QCache>
#include <QHash>
#include <QMap>
#include <QSet>
#include <QThreadPool>

#include <optional>

namespace lampblack
{

/// Exports frames with their layers apart. Layers that have not changed since the last export of the frame
/// are not exported again: it compares what they show together with the frame.
class LayersApart : public QObject
{
    Q_OBJECT

public:
    explicit LayersApart(Host& host, QObject* parent = nullptr);
    ~LayersApart() override;

    /// Export a frame with these layers, top first (empty: all visible ones). Ends with exported() or
    /// failed(), unless cancel() or markChanged() is called before. Changes nothing while the same request
    /// waits.
    void request(int frame, const QStringList& lit);
    /// Forget all that is requested. The host's own requests are cancelled by the caller.
    void cancel() { mWaiting.clear(); }

    /// The drawing of a frame has changed, in this layer. An empty name stands for any.
    void markChanged(int frame, const QString& layer);
    /// All drawings may have changed.
    void markAllChanged();

Q_SIGNALS:
    /// `layers` have something drawn in them, each with a name of its own; none if there are less than two.
    void exported(const lampblack::FrameExport& whole, const lampblack::DrawnLayers& layers);
    void failed(int frame, const lampblack::UserError& error);

private:
    using Images = QHash<QString, QImage>; ///< by the layer's name

    struct Waiting
    {
        QStringList lit;
        std::optional<FrameExport> whole;
        QSet<QString> missing;
        Images images; ///< exported, or kept from before; null where nothing is drawn
        bool reuses = false;
        quint64 number = 0; ///< counts all requests
    };

    void onExported(const FrameExport& frame);
    void onFailed(int frame, const UserError& error);
    void finishIfComplete(int frame);
    void compareWithWhole(int frame);
    void deliver(int frame);

    Host& mHost;
    QMap<int, Waiting> mWaiting;
    QCache<int, Images> mKept; ///< by frame, cost in KiB
    quint64 mRequests = 0;
    QThreadPool mComparing;
};

/// Whether `layers`, bottom first, painted over each other look like `whole`, but for rounding.
bool lookAlike(const DrawnLayers& layers, const QImage& whole);

} // namespace lampblack
