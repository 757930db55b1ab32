// The host for files of any drawing program, in a window of our own. It draws nothing: when the file is saved
// elsewhere, it is read again.
#pragma once

#include "window/file_watch.h"
#include "window/frame_exports.h"
#include "window/main_window.h"

#include <QMenu>

namespace lampblack
{

class WindowHost : public Host
{
    Q_OBJECT

public:
    explicit WindowHost(MainWindow& window, QObject* parent = nullptr);

    bool can(Ability ability) const override { return whyNot(ability).isEmpty(); }
    QString whyNot(Ability ability) const override;

    QWidget* window() const override { return &mWindow; }
    QWidget* canvas() const override { return &mWindow.canvas(); }
    void addTool(QAction* tool) override;
    void setToolPanel(QWidget*) override {}
    void addDock(QDockWidget* dock) override;
    void addLightAction(QAction* action) override { mWindow.lightMenu().addAction(action); }
    void showStatus(const QString& text, int milliseconds) override;
    void addStatusWidget(QWidget* widget) override;
    QVariant remembered(const QString& key, const QVariant& otherwise) const override;
    void remember(const QString& key, const QVariant& value) override;

    /// The frame is seen through its camera.
    std::optional<QTransform> canvasToWidget() const override;
    QSize canvasSize() const override { return mWindow.canvas().canvasSize(); }
    QColor paper() const override { return Paper::colour(); }
    void paintGuides(QPainter*) const override {}

    int currentFrame() const override { return mFrame; }
    void goToFrame(int frame) override;
    int firstFrame() const override { return mExports.shot().frames.first; }
    int frameCount() const override { return mExports.shot().frames.last; }
    double framesPerSecond() const override { return mExports.shot().framesPerSecond; }
    bool isPlaying() const override { return false; }
    FrameRange loopRange() const override { return mExports.shot().frames; }

    QVector<Layer> layers() const override { return mExports.shot().layers; }
    QString currentLayer() const override { return {}; }
    void hideLayers(const QStringList&) override {}
    void deliverLayer(const QString& name, const QMap<int, QString>& pictures) override;

    QString projectPath() const override { return mProject; }
    bool isModified() const override { return false; } ///< what is drawn is on the disk
    void markModified(bool lightModified) override { mWindow.setWindowModified(lightModified); }
    void guardLeaving(const std::function<bool()>& mayLeave) override { mMayLeave = mayLeave; }
    /// Begin to open a file, a folder or a pattern. What was open stays until it is read.
    bool openProject(const QString& path) override;
    bool saveProject() override;

    void requestFrames(int first, int last, const QStringList& layers) override;
    void cancelRequests() override { mExports.cancel(); }
    int pendingRequests() const override { return mExports.pending(); }

    /// Make the docks as wide as what they hold.
    void giveDocksRoom();
    /// Read again what could not be read, as without a renderer.
    void retry();

private:
    void onShotRead(const Shot& shot);
    void onFrameRead(int frame, const LayeredFrame& shown);
    void onFailed(const UserError& error);
    void begin(const QString& path);
    void show();

    MainWindow& mWindow;
    LayerReader mReader;
    FileWatch mWatch;
    FrameExports mExports;
    FramePainter mPainter; ///< of what the canvas shows
    QAction* mTool = nullptr;
    std::function<bool()> mMayLeave;
    QString mOpening; ///< not open yet
    QString mOpen;    ///< as it was asked for: the name of a project is that of a file
    QString mProject;
    QString mStatus; ///< shown whenever nothing else is
    int mFrame = 1;
    bool mHasFailed = false; ///< the last reading of what is open
};

} // namespace lampblack
