// A host without a drawing program: it has a window, and does what the test says.
#pragma once

#include "host/host.h"

#include <QMainWindow>
#include <QStatusBar>
#include <QtTest>

namespace lampblack
{

class FakeHost : public Host
{
public:
    /// Frames first..last with only these layers.
    struct Request
    {
        int first;
        int last;
        QStringList layers;
    };

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
    void addLightAction(QAction* action) override { mLightMenu << action; }
    void showStatus(const QString& text, int) override { mStatus = text; }
    void addStatusWidget(QWidget* widget) override { mWindow.statusBar()->addPermanentWidget(widget); }
    QVariant remembered(const QString& key, const QVariant& otherwise) const override
    {
        return mRemembered.value(key, otherwise);
    }
    void remember(const QString& key, const QVariant& value) override { mRemembered.insert(key, value); }
    std::optional<QTransform> canvasToWidget() const override { return mView; }
    QSize canvasSize() const override { return {400, 300}; }
    QColor paper() const override { return mPaper; }
    void paintGuides(QPainter* painter) const override
    {
        if (mGuides)
            mGuides(painter);
    }
    int currentFrame() const override { return mFrame; }
    void goToFrame(int frame) override
    {
        mFrame = frame;
        Q_EMIT frameChanged(frame);
    }
    int frameCount() const override { return 8; }
    double framesPerSecond() const override { return 12; }
    bool isPlaying() const override { return false; }
    FrameRange loopRange() const override { return mLoop; }
    QVector<Layer> layers() const override { return mLayers; }
    QString currentLayer() const override { return mCurrentLayer; }
    void hideLayers(const QStringList& names) override
    {
        for (Layer& layer : mLayers)
            layer.visible = layer.visible && !names.contains(layer.name);
    }
    void deliverLayer(const QString& name, const QMap<int, QString>& pictures) override
    {
        mDelivered = pictures;
        mAllDelivered << name;
        for (int row = 0; row < mLayers.size(); ++row)
        {
            if (mLayers[row].name == name)
            {
                mLayers.remove(row);
                break;
            }
        }
        mLayers.prepend({name, Layer::Kind::Bitmap, true});
        Q_EMIT layersChanged();
        Q_EMIT layerDelivered(name);
    }
    QString projectPath() const override { return mProject; }
    bool isModified() const override { return mModified; }
    void markModified(bool lightModified) override { mMarked = lightModified; }
    void guardLeaving(const std::function<bool()>& mayLeave) override { mMayLeave = mayLeave; }
    bool openProject(const QString&) override { return false; }
    bool saveProject() override
    {
        ++mSaved;
        return true;
    }
    void requestFrames(int first, int last, const QStringList& layers) override
    {
        mRequests.append({first, last, layers});
        for (int frame = first; mDraw && frame <= last; ++frame)
        {
            const QImage image = mDraw(frame, layers);
            if (image.isNull())
                Q_EMIT exportFailed(frame, {QStringLiteral("Frame %1 is broken.").arg(frame), {}, {}});
            else
                Q_EMIT frameExported({frame, image, {}, layers});
        }
    }
    void cancelRequests() override { ++mCancelled; }
    int pendingRequests() const override { return 0; }

    void setView(const QTransform& view)
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
    QVector<QAction*> mLightMenu;
    QMap<QString, QVariant> mRemembered;
    bool mMarked = false;
    QString mStatus;
    std::optional<QTransform> mView = QTransform();
    QColor mPaper = Qt::white;
    std::function<void(QPainter*)> mGuides;
    bool mModified = false;
    QVector<Layer> mLayers;
    QString mCurrentLayer;
    QVector<Ability> mCannot;
    int mFrame = 1;
    FrameRange mLoop{1, 8};
    QString mProject;
    int mSaved = 0;
    std::function<bool()> mMayLeave;
    QMap<int, QString> mDelivered; ///< the last layer
    QStringList mAllDelivered;     ///< names of the layers, in order
    QVector<Request> mRequests;
    int mCancelled = 0;
    /// What these layers of a frame show. With it each request is answered at once, and a null image means
    /// that the export fails; without it none is answered.
    std::function<QImage(int frame, const QStringList& layers)> mDraw;
};

} // namespace lampblack
