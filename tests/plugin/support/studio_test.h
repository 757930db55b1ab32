// A studio between a host without a drawing program and a worker without a process.
#pragma once

#include "plugin/studio.h"
#include "support/fake_host.h"
#include "support/fake_worker.h"
#include "tool/canvas/canvas_overlay.h"

#include <QDoubleSpinBox>
#include <QLabel>
#include <QPainter>
#include <QTemporaryDir>

namespace lampblack
{

/// Makes a studio for each test. The host has an empty project file and exports at once.
class StudioTest : public QObject
{
    Q_OBJECT

protected:
    static QImage drawing(const QColor& colour = Qt::white)
    {
        QImage image(400, 300, QImage::Format_RGBA8888);
        image.fill(Qt::transparent);
        QPainter painter(&image);
        painter.setBrush(colour);
        painter.drawEllipse(100, 50, 200, 200);
        return image;
    }
    /// A stroke has ended that changed the current frame.
    void draw()
    {
        ++mStrokes;
        Q_EMIT mHost->drawingChanged(mHost->currentFrame());
    }
    template <class Widget> Widget* find(const char* name) const
    {
        auto* found = mHost->mWindow.findChild<Widget*>(QLatin1String("lampblack.") + QLatin1String(name));
        [&]
        {
            QVERIFY2(found != nullptr, name);
        }();
        return found;
    }
    bool isReady() const { return find<QLabel>("panel.worker")->text() == QStringLiteral("Ready"); }
    /// The host reads what was asked for of frame 1: it shows `drawing`.
    void exportAll(const QImage& drawing)
    {
        const QStringList layers = mHost->mRequests.last().layers;
        for (const QStringList& each : {QStringList(layers[0]), QStringList(layers[1]), layers})
            Q_EMIT mHost->frameExported({1, drawing, {}, each});
    }
    /// Use the lamp until the picture of the current frame is shown.
    void openLit()
    {
        mHost->open();
        QTRY_VERIFY(!mWorker->mPreviews.isEmpty());
        Q_EMIT mWorker->imageArrived(mWorker->pictureOf(mHost->currentFrame()));
        QVERIFY(showsPicture());
        QVERIFY(mStudio->isSettled());
    }
    void setPower(double power) const { find<QDoubleSpinBox>("panel.power.field")->setValue(power); }
    double sentPower() const { return mWorker->mScenes.last().lights.first().power; }
    bool showsPicture() const { return find<CanvasOverlay>("overlay")->showsPicture(); }
    void setKeepsLight(bool keeps) const
    {
        for (QAction* action : mHost->mLightMenu)
        {
            if (action->objectName() == QLatin1String("lampblack.keep_light"))
                action->setChecked(keeps);
        }
    }
    bool showsStandIn() const { return find<CanvasOverlay>("overlay")->showsStandIn(); }

    std::unique_ptr<QTemporaryDir> mFolder;
    std::unique_ptr<FakeHost> mHost;
    FakeWorker* mWorker = nullptr; ///< the studio's own
    std::unique_ptr<Studio> mStudio;
    int mStrokes = 0;

private Q_SLOTS:
    void init()
    {
        mFolder = std::make_unique<QTemporaryDir>();
        mHost = std::make_unique<FakeHost>();
        mHost->mProject = mFolder->filePath(QStringLiteral("walk.pclx"));
        QVERIFY(QFile(mHost->mProject).open(QFile::WriteOnly));
        mStrokes = 0;
        mHost->mDraw = [this](int frame, const QStringList&)
        {
            return drawing(QColor::fromHsv(mStrokes, 100 + frame, 200));
        };
        auto worker = std::make_unique<FakeWorker>();
        mWorker = worker.get();
        mStudio = std::make_unique<Studio>(*mHost, std::move(worker));
    }

    void cleanup()
    {
        mStudio.reset();
        mHost.reset();
    }
};

} // namespace lampblack
