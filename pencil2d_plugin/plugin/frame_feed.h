// Drawings on their way from the host to the worker.
#pragma once

#include "host/host.h"
#include "scene/scene_document.h"
#include "worker/worker.h"

#include <QCache>
#include <QSet>

namespace lampblack
{

/// Keeps the worker's idea of each frame true: exports what is looked at or asked for, again once it
/// has changed, and never twice while it has not.
class FrameFeed : public QObject
{
    Q_OBJECT

public:
    FrameFeed(Host& host, Worker& worker, SceneDocument& document, QObject* parent = nullptr);

    /// While off, nothing is exported.
    void setOn(bool on);

    /// Whether the worker was given the frame as it is now.
    bool isFresh(int frame) const { return mFresh.contains(frame); }

    /// The last export of a frame, if it is still kept and fresh; its image is null otherwise.
    FrameExport lastExport(int frame) const;

    /// The layers that are lit; empty: all that are visible, for they cannot be told apart.
    QStringList litLayers() const;

    /// Have all of first..last exported; freshened() comes for each, at once for those that are fresh.
    void wantAll(int first, int last);
    void stopWanting();

Q_SIGNALS:
    void freshened(int frame);
    void staled(int frame);
    void failed(int frame, const lampblack::UserError& error);

private:
    void wantCurrent();
    void take(const FrameExport& frame);
    void forget(int frame);
    void forgetAll();

    Host& mHost;
    Worker& mWorker;
    SceneDocument& mDocument;
    bool mOn = false;
    QSet<int> mFresh;
    QCache<int, FrameExport> mExports; ///< cost in KiB
};

} // namespace lampblack
