// The plugin as a whole: connects the host, the worker, the scene and the tool.
#pragma once

#include "host/host.h"
#include "plugin/cut_feed.h"
#include "plugin/dock_room.h"
#include "plugin/frame_feed.h"
#include "plugin/lit_frames.h"
#include "plugin/lit_layer.h"
#include "plugin/lit_view.h"
#include "plugin/project_scene.h"
#include "plugin/shot_job.h"
#include "plugin/unlit_layers.h"
#include "scene/scene_document.h"
#include "tool/lamp_tool.h"
#include "worker/worker.h"

#include <QMap>
#include <QPointF>
#include <QVariant>

#include <memory>

namespace lampblack
{

/// Its objectName is "lampblack". Its properties are read by tests and measurements.
class Studio : public QObject
{
    Q_OBJECT
    Q_PROPERTY(qulonglong sentRevision READ sentRevision)   ///< revision of the scene last sent
    Q_PROPERTY(qulonglong shownRevision READ shownRevision) ///< revision of the scene in the shown picture
    Q_PROPERTY(bool settled READ isSettled)                 ///< the shown picture is converged and up to date
    Q_PROPERTY(QString project READ project)                ///< path of the project last opened
    Q_PROPERTY(QVariantList lightPlaces READ
                   lightPlaces) ///< [x, y] of each light at the current frame, canvas pixels
    Q_PROPERTY(QVariantList cutPlaces READ cutPlaces) ///< points of each cut that is shown, canvas pixels

public:
    Studio(Host& host, std::unique_ptr<Worker> worker, QObject* parent = nullptr);
    ~Studio() override;

    qulonglong sentRevision() const { return mSentRevision; }
    qulonglong shownRevision() const { return mShownImage.revision; }
    bool isSettled() const;
    QString project() const { return mProjectPath; }
    QVariantList lightPlaces() const;
    QVariantList cutPlaces() const;

    /// Remove everything from the window and end the worker.
    void close();

private:
    void onToolActive(bool active);
    void updateFeed();
    void sendScene();
    void onPaletteArrived(int frame, const QVector<Swatch>& swatches);
    void connectJobs();
    FrameRange selectedRange() const;

    Host& mHost;
    SceneDocument mDocument;
    std::unique_ptr<Worker> mWorker;
    std::unique_ptr<LampTool> mTool;
    std::unique_ptr<FrameFeed> mFeed;
    std::unique_ptr<UnlitLayers> mUnlit;
    std::unique_ptr<LitView> mView;
    std::unique_ptr<CutFeed> mCuts;
    std::unique_ptr<LitLayer> mLayer;
    std::unique_ptr<ShotJob> mJob;
    std::unique_ptr<LitFrames> mLitFrames;
    std::unique_ptr<ProjectScene> mProject;
    DockRoom mMaterialsRoom;
    QMap<QString, quint64> mColourPixels; ///< most pixels that each flat colour had in one frame
    QString mProjectPath;
    qulonglong mSentRevision = 0;
    PreviewImage mShownImage;
};

} // namespace lampblack
