#include "window/frame_painter.h"

#include <QPainter>

namespace lampblack
{

QImage paintLayers(const QStringList& files, const QSize& size)
{
    if (files.size() == 1) // its colours are not rounded
        return QImage(files.first()).convertToFormat(QImage::Format_RGBA8888);
    QImage together;
    QPainter painter;
    for (const QString& file : files)
    {
        const QImage layer(file);
        if (layer.isNull())
            return {};
        if (together.isNull())
        {
            together = layer.convertToFormat(QImage::Format_RGBA8888_Premultiplied);
            painter.begin(&together);
        }
        else
        {
            painter.drawImage(0, 0, layer);
        }
    }
    painter.end();
    if (together.isNull())
    {
        together = QImage(size, QImage::Format_RGBA8888);
        together.fill(Qt::transparent);
    }
    return together.convertToFormat(QImage::Format_RGBA8888);
}

FramePainter::FramePainter(QObject* parent) : QObject(parent)
{
    mThread.setMaxThreadCount(1);
}

FramePainter::~FramePainter()
{
    mThread.clear();
    mThread.waitForDone();
}

void FramePainter::paint(const QStringList& files, const QSize& size,
                         const std::function<void(const QImage&)>& done)
{
    mThread.start(
        [this, files, size, done, cancelled = mCancelled]
        {
            const QImage image = paintLayers(files, size);
            QMetaObject::invokeMethod(
                this,
                [this, image, done, cancelled]
                {
                    if (cancelled == mCancelled)
                        done(image);
                },
                Qt::QueuedConnection);
        });
}

void FramePainter::cancel()
{
    ++mCancelled;
    mThread.clear();
}

} // namespace lampblack
