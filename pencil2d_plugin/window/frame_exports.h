// Answers the host's requests for frames, as soon as these are read.
#pragma once

#include "window/frame_painter.h"
#include "window/layer_reader.h"

namespace lampblack
{

class FrameExports : public QObject
{
    Q_OBJECT

public:
    using QObject::QObject;

    void request(int frame, const QStringList& layers);
    void cancel();
    int pending() const { return mRequests.size(); }

    /// What the drawing shows now. Its frames are forgotten.
    void begin(const Shot& shot);
    /// The same drawing was read again.
    void setShot(const Shot& shot) { mShot = shot; }
    /// Requests that wait for the frame are answered, and those that are being answered begin again.
    void setFrame(int frame, const LayeredFrame& shown);

    const Shot& shot() const { return mShot; }
    const QMap<int, LayeredFrame>& frames() const { return mFrames; }
    /// Pictures of the layers of a frame that was read, bottom first. No layers stand for all visible ones.
    QStringList files(int frame, const QStringList& layers) const;

Q_SIGNALS:
    void exported(const lampblack::FrameExport& frame);
    void failed(int frame, const lampblack::UserError& error);

private:
    struct Request
    {
        int frame;
        QStringList layers;
        quint64 painting = 0; ///< number of the attempt; 0 for none
    };

    void answer(int frame);
    void finish(quint64 painting, const QImage& image);

    Shot mShot;
    QMap<int, LayeredFrame> mFrames;
    QVector<Request> mRequests;
    FramePainter mPainter;
    quint64 mPaintings = 0;
};

} // namespace lampblack
