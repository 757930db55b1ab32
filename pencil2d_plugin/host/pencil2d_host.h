// The host for an unmodified Pencil2D 0.6 or 0.7. It uses its widgets, actions and meta-objects.
#pragma once

#include "host/camera_survey.h"
#include "host/drawing_watch.h"
#include "host/frame_queue.h"
#include "host/guides.h"
#include "host/layer_delivery.h"
#include "host/leave_guard.h"
#include "host/options_page.h"
#include "host/project_watch.h"
#include "host/title_mark.h"
#include "host/tool_palette.h"
#include "host/transport.h"
#include "host/window_places.h"

namespace lampblack
{

class Pencil2DHost : public Host
{
    Q_OBJECT

public:
    Pencil2DHost(const Parts& parts, QObject* parent);
    ~Pencil2DHost() override;

    bool can(Ability ability) const override;
    QString whyNot(Ability ability) const override;

    QWidget* window() const override { return mParts.window; }
    QWidget* canvas() const override { return mParts.canvas; }
    void addTool(QAction* tool) override;
    void setToolPanel(QWidget* panel) override;
    void addDock(QDockWidget* dock) override { mPlaces.addDock(dock); }
    void addLightAction(QAction* action) override { mPlaces.addLightAction(action); }
    void showStatus(const QString& text, int milliseconds) override;
    void addStatusWidget(QWidget* widget) override { mPlaces.addStatusWidget(widget); }
    QVariant remembered(const QString& key, const QVariant& otherwise) const override;
    void remember(const QString& key, const QVariant& value) override;

    std::optional<QTransform> canvasToWidget() const override;
    QSize canvasSize() const override { return mCanvasSize; }
    QColor paper() const override;
    void paintGuides(QPainter* painter) const override { mGuides.paint(painter); }

    int currentFrame() const override { return mTransport.currentFrame(); }
    void goToFrame(int frame) override;
    int frameCount() const override { return mTransport.frameCount(); }
    double framesPerSecond() const override { return mTransport.framesPerSecond(); }
    bool isPlaying() const override { return mTransport.isPlaying(); }
    FrameRange loopRange() const override { return mTransport.loopRange(); }

    QVector<Layer> layers() const override { return mLayers; }
    QString currentLayer() const override { return mLayers.value(mCurrentRow).name; }
    void hideLayers(const QStringList& names) override;
    void deliverLayer(const QString& name, const QMap<int, QString>& pictures) override;

    QString projectPath() const override { return mProject.path(); }
    bool isModified() const override { return mProject.isModified(); }
    void markModified(bool lightModified) override { mTitleMark.setMarked(lightModified); }
    void guardLeaving(const std::function<bool()>& mayLeave) override { mLeaveGuard.setMayLeave(mayLeave); }
    bool openProject(const QString& path) override { return mProject.open(path); }
    bool saveProject() override { return mProject.save(); }

    void requestFrames(int first, int last, const QStringList& layers) override;
    void cancelRequests() override { mQueue.cancel(); }
    int pendingRequests() const override { return mQueue.pending(); }

private Q_SLOTS:
    void onCurrentLayerChanged(int index);
    void forgetPaper() { mPaper = QColor(); }
    void restoreStatus(const QString& shown);

private:
    void surveyProject();
    void surveyCamera();
    void leaveCamera();
    void onCameraRead(const CameraPath& path);
    void forgetCamera();
    void onDialogRead(const ExportResult& exported);
    void onExported(int frame, const QStringList& layers, const QImage& image);
    void onProjectOpened(const QString& path);
    void onLayersMaybeChanged();
    bool surveyLayers();
    void surveyEyes();
    bool isCamera(int row) const;

    Parts mParts;
    Idleness mIdleness;
    Transport mTransport;
    ProjectWatch mProject;
    LeaveGuard mLeaveGuard;
    TitleMark mTitleMark;
    WindowPlaces mPlaces;
    LayerRows mRows;
    Guides mGuides;
    mutable ViewReader mView;
    FrameQueue mQueue;
    LayerDelivery mDelivery;
    DrawingWatch mDrawing;
    ToolPalette mPalette;
    CameraSurvey mCameraSurvey;
    OptionsPage mOptions;
    QTimer mSurveyTimer;

    QVector<Layer> mLayers;
    CameraPath mCamera;
    QString mCameraName;
    QSize mCanvasSize;
    mutable QColor mPaper;
    QString mStatus;      ///< shown whenever nothing else is
    int mCurrentRow = -1; ///< of mLayers
    int mLayerAttempts = 0;
    bool mLayersKnown = false;
    bool mCameraKnown = false;
    bool mOnCamera = false; ///< the current layer is a camera
    bool mLayersAnswer = true;
};

} // namespace lampblack
