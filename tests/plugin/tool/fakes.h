// A host and a worker that do as they are told.
#pragma once

#include "host/host.h"
#include "scene/scene_document.h"
#include "worker/worker.h"

#include <QLineF>
#include <QMainWindow>
#include <QMouseEvent>
#include <QtTest>

namespace lampblack
{

class FakeHost : public Host
{
public:
    FakeHost()
    {
        mWindow.resize(1000, 600);
        mCanvas = new QWidget;
        mCanvas->setFocusPolicy(Qt::StrongFocus);
        mCanvas->setMouseTracking(true);
        mWindow.setCentralWidget(mCanvas);
        mLayers = {{QStringLiteral("Line"), Layer::Kind::Bitmap, true},
                   {QStringLiteral("Camera"), Layer::Kind::Camera, true},
                   {QStringLiteral("Hills"), Layer::Kind::Bitmap, true}};
    }

    bool can(Ability ability) const override { return !mCannot.contains(ability); }
    QString whyNot(Ability) const override { return QStringLiteral("This version keeps it to itself."); }
    QWidget* window() const override { return const_cast<QMainWindow*>(&mWindow); }
    QWidget* canvas() const override { return mCanvas; }
    void addTool(QAction* tool) override
    {
        mTool = tool;
        mWindow.addAction(tool);
        connect(tool, &QAction::toggled, this, &Host::toolActivated);
    }
    void setToolPanel(QWidget* panel) override
    {
        mPanel = panel;
        auto* dock = new QDockWidget;
        dock->setWidget(panel);
        mWindow.addDockWidget(Qt::LeftDockWidgetArea, dock);
    }
    void addDock(QDockWidget* dock) override { mWindow.addDockWidget(Qt::RightDockWidgetArea, dock); }
    void addAnimationAction(QAction* action) override { mAnimation << action; }
    void showStatus(const QString& text, int) override { mStatus = text; }
    std::optional<QTransform> canvasToWidget() const override { return mView; }
    QSize canvasSize() const override { return {400, 300}; }
    QColor paper() const override { return mPaper; }
    int currentFrame() const override { return mFrame; }
    void goToFrame(int frame) override
    {
        mFrame = frame;
        Q_EMIT frameChanged(frame);
    }
    int frameCount() const override { return 8; }
    double framesPerSecond() const override { return 12; }
    bool isPlaying() const override { return false; }
    FrameRange loopRange() const override { return {1, 8}; }
    QVector<Layer> layers() const override { return mLayers; }
    void hideLayers(const QStringList&) override {}
    void deliverLayer(const QString&, const QMap<int, QString>&) override {}
    QString projectPath() const override { return {}; }
    bool isModified() const override { return false; }
    void guardLeaving(const std::function<bool()>& mayLeave) override { mMayLeave = mayLeave; }
    bool openProject(const QString&) override { return false; }
    bool saveProject() override { return false; }
    void requestFrames(int, int, const QStringList&) override {}
    void cancelRequests() override {}
    int pendingRequests() const override { return 0; }

    void look(const QTransform& view)
    {
        mView = view;
        Q_EMIT viewChanged();
    }
    /// Put the window up with the lamp in use.
    void open()
    {
        mWindow.show();
        QVERIFY(QTest::qWaitForWindowExposed(&mWindow));
        mWindow.activateWindow();
        if (mTool != nullptr)
            mTool->setChecked(true);
    }

    QMainWindow mWindow;
    QWidget* mCanvas = nullptr;
    QAction* mTool = nullptr;
    QWidget* mPanel = nullptr;
    QVector<QAction*> mAnimation;
    QString mStatus;
    std::optional<QTransform> mView = QTransform();
    QColor mPaper = Qt::white;
    QVector<Layer> mLayers;
    QVector<Ability> mCannot;
    int mFrame = 1;
    std::function<bool()> mMayLeave;
};

class FakeWorker : public Worker
{
public:
    State state() const override { return mState; }
    void start() override {}
    void stop() override {}
    void putFrame(int frame, const QImage&, const QTransform&) override { mPut.append(frame); }
    void dropFrame(int) override {}
    void dropAllFrames() override {}
    void setScene(const Scene&) override {}
    quint64 revision() const override { return 0; }
    bool isCurrent(const LookImage&) const override { return true; }
    void look(int, Show, const QRectF&, const QSize&) override {}
    void stopLooking() override {}
    void askPalette(int) override {}
    quint64 render(const QString&, const QString&, Quality, bool) override { return 0; }
    void cancelRender(quint64) override {}

    QVector<int> mPut;
    State mState = State::Ready;
};

/// A mouse event as the window system would send it, modifiers and held buttons included.
inline void sendMouse(QWidget* widget, QEvent::Type type, const QPointF& at, Qt::MouseButton button,
                      Qt::MouseButtons held, Qt::KeyboardModifiers modifiers = Qt::NoModifier)
{
    QMouseEvent event(type, at, widget->mapToGlobal(at.toPoint()), button, held, modifiers);
    QCoreApplication::sendEvent(widget, &event);
}

/// Press at the first point, go through the others, and let go at the last.
inline void dragMouse(QWidget* widget, const QVector<QPointF>& way,
                      Qt::KeyboardModifiers modifiers = Qt::NoModifier, bool letGo = true)
{
    sendMouse(widget, QEvent::MouseButtonPress, way.first(), Qt::LeftButton, Qt::LeftButton, modifiers);
    for (const QPointF& at : way.mid(1))
        sendMouse(widget, QEvent::MouseMove, at, Qt::NoButton, Qt::LeftButton, modifiers);
    if (letGo)
        sendMouse(widget, QEvent::MouseButtonRelease, way.last(), Qt::LeftButton, Qt::NoButton, modifiers);
}

inline Scene sceneWithLight(double x, double y, double z)
{
    Scene scene = defaultScene(QSize(400, 300));
    scene.lights[0].x = x;
    scene.lights[0].y = y;
    scene.lights[0].z = z;
    scene.lights[0].size = 100;
    return scene;
}

} // namespace lampblack
