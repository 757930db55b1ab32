// The layers that are not lit, as drawn: they show under and over the lit picture.
#pragma once

#include "plugin/frame_feed.h"
#include "plugin/layer_stack.h"

#include <QCache>

namespace lampblack
{

class Surroundings : public QObject
{
    Q_OBJECT

public:
    Surroundings(Host& host, FrameFeed& feed, SceneDocument& document, QObject* parent = nullptr);

    /// Whether both are known; a frame that has none is known.
    bool isKnown(int frame) const;

    /// Null images where there is nothing.
    FrameExport below(int frame) const { return kept(frame, stack().below); }
    FrameExport above(int frame) const { return kept(frame, stack().above); }

Q_SIGNALS:
    void arrived(int frame);

private:
    LayerStack stack() const;
    FrameExport kept(int frame, const QStringList& layers) const;
    void want(int frame);
    void take(FrameExport frame);
    void forget(int frame);
    void giveUp(int frame);

    using Key = QPair<int, QStringList>;

    Host& mHost;
    FrameFeed& mFeed;
    SceneDocument& mDocument;
    QCache<Key, FrameExport> mKept; ///< cost in KiB
    QMap<QStringList, QImage> mLast;
};

} // namespace lampblack
