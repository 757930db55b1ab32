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

/// The layers that are lit, and those whose paint is light; top first.
struct WantedLayers
{
    QStringList lit; ///< empty: all visible ones
    QStringList light;
};

/// Exports frames with their layers apart. Lit layers that have not changed since the last export of the
/// frame are not exported again: it compares what they show together with the frame.
class LayersApart : public QObject
{
    Q_OBJECT

public:
    explicit LayersApart(Host& host, QObject* parent = nullptr);
    ~LayersApart() override;

    /// Export a frame with these layers. Ends with exported() or failed(), unless cancel() or markChanged()
    /// is called before. Changes nothing while the same request waits.
    void request(int frame, const WantedLayers& wanted);
    /// Forget all that is requested. The host's own requests are cancelled by the caller.
    void cancel() { mWaiting.clear(); }

    /// The drawing of a frame has changed, in this layer. An empty name stands for any.
    void markChanged(int frame, const QString& layer);
    /// All drawings may have changed.
    void markAllChanged();

Q_SIGNALS:
    /// `layers` have something drawn in them, each with a name of its own; none if there are less than two
    /// lit ones. Above them, or alone, is painted light, by the name of its layer.
    void exported(const lampblack::FrameExport& whole, const lampblack::DrawnLayers& layers);
    void failed(int frame, const lampblack::UserError& error);

private:
    using Images = QHash<QString, QImage>; ///< by the layer's name

    struct Waiting
    {
        WantedLayers wanted;
        std::optional<FrameExport> whole;
        std::optional<QImage> light; ///< painted; null where nothing is
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
