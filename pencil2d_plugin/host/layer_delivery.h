// Makes a layer of the open project from pictures of frames.
#pragma once

#include "host/camera_path.h"
#include "host/idleness.h"
#include "host/layer_rows.h"

#include <QMap>
#include <QTemporaryDir>
#include <QThreadPool>
#include <QTimer>

namespace lampblack
{

/// Writes the layer to a file in another thread. When the artist is idle, Pencil2D imports it in one step.
class LayerDelivery : public QObject
{
    Q_OBJECT

public:
    LayerDelivery(const Parts& parts, Idleness* idleness, QObject* parent);
    ~LayerDelivery() override;

    /// See Host::deliverLayer(). `camera` is the camera of the export.
    void deliver(const QString& name, const QMap<int, QString>& pictures, const CameraPath& camera,
                 int frameCount);
    void cancel();

    /// Nothing is imported while the animation plays.
    void setPlaying(bool playing) { mPlaying = playing; }

Q_SIGNALS:
    void delivered(const QString& name);
    void failed(const lampblack::UserError& error);

private:
    void importWhenIdle();
    QString replaceLayer(const QString& project);
    void reportFailure(const QString& details);

    Parts mParts;
    Idleness* mIdleness;
    LayerRows mRows;
    QTemporaryDir mFolder; ///< kept until the end: Pencil2D may read key frames from it again
    QThreadPool mWriters;
    QTimer mTimer;
    QString mName;
    QString mProject; ///< path of the file to import
    quint64 mNumber = 0;
    bool mPlaying = false;
};

} // namespace lampblack
