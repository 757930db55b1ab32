// The layers that are not lit. They are shown as drawn, under and over the lit picture.
#pragma once

#include "plugin/frame_feed.h"
#include "plugin/layer_stack.h"

#include <QCache>

namespace lampblack
{

class UnlitLayers : public QObject
{
    Q_OBJECT

public:
    UnlitLayers(Host& host, FrameFeed& feed, SceneDocument& document, QObject* parent = nullptr);

    /// Whether the layers above and below are both loaded, or the frame has none.
    bool isLoaded(int frame) const;

    /// The layers as one image; null where there are none.
    FrameExport below(int frame) const { return cached(frame, stack().below); }
    FrameExport above(int frame) const { return cached(frame, stack().above); }

Q_SIGNALS:
    void loaded(int frame);

private:
    LayerStack stack() const;
    FrameExport cached(int frame, const QStringList& layers) const;
    void requestFrame(int frame);
    void onFrameExported(FrameExport frame);
    void invalidate(int frame);
    void onExportFailed(int frame);

    using Key = QPair<int, QStringList>;

    Host& mHost;
    FrameFeed& mFeed;
    SceneDocument& mDocument;
    QCache<Key, FrameExport> mCache;       ///< cost in KiB
    QMap<QStringList, QImage> mLastImages; ///< shared by frames that show the same
};

} // namespace lampblack
