// A worker without a process: it keeps what it is asked, and answers when the test says so.
#pragma once

#include "worker/worker.h"

#include <QCryptographicHash>
#include <QFile>
#include <QtTest>

namespace lampblack
{

class FakeWorker : public Worker
{
public:
    struct PreviewRequest
    {
        int frame;
        Show show;
        QRectF crop;
        QSize size;
    };

    State state() const override { return mState; }
    void start() override { ++mStarted; }
    void stop() override { ++mStopped; }
    void setDevice(Device device) override { mDevice = device; }
    void setComputer(const std::optional<Computer>& computer) override { mComputer = computer; }
    void putFrame(int frame, const QImage& image, const QTransform&, const DrawnLayers& layers) override
    {
        mPut.append(frame);
        mLayers.append(layers);
        mKnown.insert(frame, image);
        // Later, as from a thread.
        QMetaObject::invokeMethod(
            this, [this, frame] { Q_EMIT drawingKnown(frame); }, Qt::QueuedConnection);
    }
    QByteArray digestOf(int frame) const
    {
        const QImage image = mKnown.value(frame);
        return QCryptographicHash::hash(
            QByteArray::fromRawData(reinterpret_cast<const char*>(image.constBits()),
                                    int(image.sizeInBytes())),
            QCryptographicHash::Sha1);
    }
    void dropFrame(int frame) override { mKnown.remove(frame); }
    void dropAllFrames() override
    {
        ++mDropped;
        mKnown.clear();
    }
    void setScene(const Scene& scene) override { mScenes.append(scene); }
    quint64 revision() const override { return quint64(mScenes.size()); }
    Fit fit(const PreviewImage& image) const override
    {
        if (!mKnown.contains(image.frame))
            return Fit::Unknown;
        if (image.digest != digestOf(image.frame))
            return Fit::OldDrawing;
        return image.show != Show::Lit || image.revision == revision() ? Fit::Current : Fit::OldScene;
    }
    void requestPreview(int frame, Show show, const QRectF& crop, const QSize& size) override
    {
        mPreviews.append({frame, show, crop, size});
    }
    void cancelPreview() override { ++mPreviewsCancelled; }
    void requestPalette(int frame) override { mPalettes.append(frame); }
    void requestOverlaps(int frame) override { mOverlaps.append(frame); }
    void requestNormals(int frame) override { mNormals.append(frame); }
    void requestRigs(int frame, int side) override { mRigs.append({frame, side}); }
    quint64 render(const QString& frames, const QString& output, Quality quality, const QString& project,
                   ApartKind apart) override
    {
        mApart = apart;
        mFrames = frames;
        mOutput = output;
        mQuality = quality;
        mProject = project;
        return ++mJob;
    }
    void cancelRender(quint64) override { ++mCancelled; }

    /// A picture of the frame's drawing under the scene, both as they are now.
    PreviewImage pictureOf(int frame, Show show = Show::Lit) const
    {
        PreviewImage image;
        image.frame = frame;
        image.show = show;
        image.crop = QRectF(0, 0, 400, 300);
        image.picture = QImage(4, 3, QImage::Format_RGBA8888_Premultiplied);
        image.picture.fill(Qt::red);
        image.digest = digestOf(frame);
        image.revision = revision();
        image.converged = true;
        return image;
    }
    void setState(State state)
    {
        mState = state;
        Q_EMIT stateChanged(state);
    }
    /// Write the file of each frame, and say so.
    void finishFrames(const QVector<int>& frames)
    {
        for (const int frame : frames)
        {
            QFile file(QString(mOutput).replace(QStringLiteral("%04d"), QStringLiteral("000%1").arg(frame)));
            QVERIFY(file.open(QFile::WriteOnly));
            Q_EMIT renderFrameDone(mJob, frame, file.fileName());
        }
    }
    void endJob() { Q_EMIT renderDone(mJob, QStringLiteral("finished"), 0, 0, 0); }

    State mState = State::Ready;
    Device mDevice = Device::Auto;
    std::optional<Computer> mComputer;
    int mStarted = 0;
    int mStopped = 0;
    QVector<int> mPut;
    QMap<int, QImage> mKnown;     ///< the drawing of each frame that was not dropped
    QVector<DrawnLayers> mLayers; ///< of each that was put
    int mDropped = 0;             ///< how often all frames were
    QVector<Scene> mScenes;
    QVector<PreviewRequest> mPreviews;
    int mPreviewsCancelled = 0;
    QVector<int> mPalettes;
    QVector<int> mOverlaps;         ///< frames whose overlaps were asked for
    QVector<int> mNormals;          ///< frames whose normals were asked for
    QVector<QPair<int, int>> mRigs; ///< frames whose rigs were asked for, and the sides of their pictures
    QString mFrames;                ///< of the last job, as are the next four
    QString mOutput;
    Quality mQuality = Quality::Low;
    QString mProject; ///< that is rendered from its file
    ApartKind mApart = ApartKind::None;
    quint64 mJob = 0;
    int mCancelled = 0;
};

} // namespace lampblack
