// Exports requested frames, a few at a time while the artist is idle.
#pragma once

#include "host/export_dialog.h"
#include "host/idleness.h"
#include "host/layer_rows.h"

#include <QMap>
#include <QTemporaryDir>
#include <QThreadPool>
#include <QTimer>

namespace lampblack
{

class FrameQueue : public QObject
{
    Q_OBJECT

public:
    FrameQueue(const Parts& parts, Idleness* idleness, QObject* parent);
    ~FrameQueue() override;

    /// See Host::requestFrames().
    void request(int first, int last, const QStringList& layers);
    void cancel();
    int pending() const { return mRequests.size() + mReading; }

    /// This frame is exported first.
    void setCurrentFrame(int frame) { mCurrentFrame = frame; }
    /// Nothing is exported while the animation plays.
    void setPlaying(bool playing) { mPlaying = playing; }
    /// Export nothing for now.
    void setWaiting(bool waiting) { mWaiting = waiting; }
    void setCamera(const QString& name) { mCamera = name; }
    /// The layers, top first, as last read. Needed to hide the right rows.
    void setLayers(const QVector<Layer>& layers) { mLayers = layers; }

Q_SIGNALS:
    void exported(int frame, const QStringList& layers, const QImage& image);
    void failed(int frame, const lampblack::UserError& error);
    void dialogRead(const lampblack::ExportResult& exported);

private:
    void exportNext();
    using Request = QPair<int, QStringList>; ///< a frame and its layers to export

    void exportChunk(int first, int last, const QStringList& layers);
    /// Read the exported file in another thread. `failures` is how often the request failed before.
    void readLater(const Request& request, int failures, const QString& path, quint64 number);
    /// Request the frame again, or emit failed().
    void retryOrFail(const Request& request, int failures, const QString& details);

    Parts mParts;
    Idleness* mIdleness;
    LayerRows mRows;
    ExportDialog mDialog;
    QTemporaryDir mFolder;
    QTimer mTimer;
    QThreadPool mReaders;
    QMap<Request, int> mRequests; ///< number of failures by request
    QVector<Layer> mLayers;
    QString mCamera;
    QMap<Request, quint64> mNewest; ///< the number of the newest export
    quint64 mExports = 0;
    int mReading = 0;
    int mCurrentFrame = 1;
    double mFrameMs = 60; ///< time to export a frame, as last measured
    bool mPlaying = false;
    bool mWaiting = false;
};

} // namespace lampblack

Q_DECLARE_METATYPE(lampblack::ExportResult)
