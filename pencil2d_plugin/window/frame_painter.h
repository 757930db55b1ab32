// Paints the layers of a frame over each other, outside Qt's main thread.
#pragma once

#include <QImage>
#include <QObject>
#include <QThreadPool>

#include <functional>

namespace lampblack
{

/// Of `size`, or of that of the first file: Format_RGBA8888. `files` are PNG, bottom first. A null image if
/// one cannot be read.
QImage paintLayers(const QStringList& files, const QSize& size);

class FramePainter : public QObject
{
    Q_OBJECT

public:
    explicit FramePainter(QObject* parent = nullptr);
    ~FramePainter() override;

    /// `done` is called in the main thread with what paintLayers() returns, unless cancel() is called before.
    void paint(const QStringList& files, const QSize& size, const std::function<void(const QImage&)>& done);
    void cancel();

private:
    QThreadPool mThread;
    quint64 mCancelled = 0; ///< how many times
};

} // namespace lampblack
