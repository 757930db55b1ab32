// Frames that were asked for, exported a few at a time while the artist's hands are off.
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
    int pending() const { return mWanted.size() + mReading; }

    /// Frame that goes first among those wanted.
    void setCurrentFrame(int frame) { mCurrentFrame = frame; }
    /// Nothing is exported meanwhile.
    void setPlaying(bool playing) { mPlaying = playing; }
    void setCamera(const QString& name) { mCamera = name; }
    /// The layers top first, as they were last read: which rows to hide.
    void setLayers(const QVector<Layer>& layers) { mLayers = layers; }

Q_SIGNALS:
    void exported(int frame, const QStringList& layers, const QImage& image);
    void failed(int frame, const lampblack::UserError& error);
    void looked(const lampblack::Exported& exported);

private:
    void work();
    using Wanted = QPair<int, QStringList>; ///< a frame, and its layers that are asked for

    void exportChunk(int first, int last, const QStringList& layers);
    /// Reads the export in another thread; it failed as often before.
    void readLater(const Wanted& wanted, int failures, const QString& path, quint64 number);
    /// Wants the frame again, or gives it up.
    void fail(const Wanted& wanted, int failures, const QString& details);

    Parts mParts;
    Idleness* mIdleness;
    LayerRows mRows;
    ExportDialog mDialog;
    QTemporaryDir mFolder;
    QTimer mTimer;
    QThreadPool mReaders;
    QMap<Wanted, int> mWanted; ///< how often it failed
    QVector<Layer> mLayers;
    QString mCamera;
    QMap<Wanted, quint64> mNewest; ///< the number of the newest export
    quint64 mExports = 0;
    int mReading = 0;
    int mCurrentFrame = 1;
    double mFrameMs = 60; ///< what a frame costs, as last measured
    bool mPlaying = false;
};

} // namespace lampblack

Q_DECLARE_METATYPE(lampblack::Exported)
