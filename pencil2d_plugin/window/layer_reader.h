// Reads drawings of all programs: the worker's command `layers` turns them into PNG files.
#pragma once

#include "host/host.h"

#include <QMap>
#include <QPointer>
#include <QProcess>
#include <QTemporaryDir>

namespace lampblack
{

/// A drawing, or a sequence of them.
struct Shot
{
    QSize canvas;
    double framesPerSecond = 12;
    FrameRange frames;
    QVector<Layer> layers; ///< top first
};

/// What a frame shows.
struct LayeredFrame
{
    QTransform view;              ///< canvas to image
    QMap<QString, QString> files; ///< by the layer's name; no file where nothing is drawn
    QString whole;                ///< all visible layers, where they are not merely painted over each other
    std::optional<UserError> error;

    bool isSame(const LayeredFrame& other) const;
};

/// It reads in a process of its own. Pictures of the drawing read last are kept until they are replaced.
class LayerReader : public QObject
{
    Q_OBJECT

public:
    explicit LayerReader(QObject* parent = nullptr);
    ~LayerReader() override;

    /// Read a file, a folder or a pattern, beginning with a frame. A reading that is under way is given up.
    /// Ends with finished() or failed().
    void read(const QString& path, int firstFrame);
    bool isReading() const { return !mProcess.isNull(); }

Q_SIGNALS:
    void shotRead(const lampblack::Shot& shot); ///< before its frames
    void frameRead(int frame, const lampblack::LayeredFrame& shown);
    void finished(const QString& warnings); ///< for people; empty without any
    void failed(const lampblack::UserError& error);

private:
    void give(QProcess* process);
    void readLines();
    void readLine(const QByteArray& line);
    void fail(const UserError& error);
    void onEnded(int code, const QString& reason);
    QString fileIn(const QString& name) const;

    QTemporaryDir mFolder; ///< of the pictures
    QPointer<QProcess> mProcess;
    QByteArray mErrors; ///< the end of what the process says to people
};

} // namespace lampblack
