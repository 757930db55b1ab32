// Joins the host, the worker, the scene and the tool: the plugin as a whole.
#pragma once

#include "host/host.h"
#include "plugin/dock_room.h"
#include "plugin/frame_feed.h"
#include "plugin/lit_layer.h"
#include "plugin/lit_view.h"
#include "plugin/project_scene.h"
#include "plugin/shot_job.h"
#include "plugin/surroundings.h"
#include "scene/scene_document.h"
#include "tool/lamp_tool.h"
#include "worker/worker.h"

#include <QMap>
#include <QPointF>
#include <QVariant>

#include <memory>

namespace lampblack
{

/// Found by the name "lampblack"; its properties tell how far the light has followed.
class Studio : public QObject
{
    Q_OBJECT
    Q_PROPERTY(qulonglong sentRevision READ sentRevision)   ///< of the scene as last set
    Q_PROPERTY(qulonglong shownRevision READ shownRevision) ///< of the scene in the picture shown
    Q_PROPERTY(bool settled READ isSettled) ///< the picture shown is converged and of this scene and drawing
    Q_PROPERTY(
        QVariantList lightPlaces READ lightPlaces) ///< [x, y] of each light as it is now, canvas pixels

public:
    Studio(Host& host, std::unique_ptr<Worker> worker, QObject* parent = nullptr);
    ~Studio() override;

    qulonglong sentRevision() const { return mSent; }
    qulonglong shownRevision() const { return mShown.revision; }
    bool isSettled() const;
    QVariantList lightPlaces() const;

    /// Lets go of the window's parts and ends the worker.
    void close();

private:
    void follow(bool active);
    void send();
    void takePalette(int frame, const QVector<Swatch>& swatches);
    void connectJobs();
    FrameRange chosenRange() const;

    Host& mHost;
    SceneDocument mDocument;
    std::unique_ptr<Worker> mWorker;
    std::unique_ptr<LampTool> mTool;
    std::unique_ptr<FrameFeed> mFeed;
    std::unique_ptr<Surroundings> mAround;
    std::unique_ptr<LitView> mView;
    std::unique_ptr<LitLayer> mLayer;
    std::unique_ptr<ShotJob> mJob;
    std::unique_ptr<ProjectScene> mProject;
    DockRoom mRoom;
    QMap<QString, qint64> mColours; ///< flat colours of the frames seen, and how many pixels wear each
    qulonglong mSent = 0;
    LookImage mShown;
};

} // namespace lampblack
