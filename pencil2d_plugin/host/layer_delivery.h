// Pictures of frames, made a layer of the open project.
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

/// Prepares the layer in another thread, then has Pencil2D take it in, in one go, once the artist's hands
/// are off.
class LayerDelivery : public QObject
{
    Q_OBJECT

public:
    LayerDelivery(const Parts& parts, Idleness* idleness, QObject* parent);
    ~LayerDelivery() override;

    /// See Host::deliverLayer(); `camera` is what the frames were exported through.
    void deliver(const QString& name, const QMap<int, QString>& pictures, const CameraKeys& camera,
                 int frameCount);
    void cancel();

    /// Nothing is taken in meanwhile.
    void setPlaying(bool playing) { mPlaying = playing; }

Q_SIGNALS:
    void delivered(const QString& name);
    void failed(const lampblack::UserError& error);

private:
    void takeIn();
    QString replace(const QString& project);
    void fail(const QString& details);

    Parts mParts;
    Idleness* mIdleness;
    LayerRows mRows;
    QTemporaryDir mFolder; ///< lives as long as we do: Pencil2D may read key frames from it again
    QThreadPool mWriters;
    QTimer mTimer;
    QString mName;
    QString mProject; ///< ready to be taken in
    quint64 mNumber = 0;
    bool mPlaying = false;
};

} // namespace lampblack
