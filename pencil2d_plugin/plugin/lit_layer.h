// The result layer, "Lit": rendered frames as a layer of the project.
#pragma once

#include "host/host.h"
#include "scene/scene_document.h"

#include <QMap>
#include <QSet>
#include <QThreadPool>

namespace lampblack
{

class LitLayer : public QObject
{
    Q_OBJECT

public:
    LitLayer(Host& host, SceneDocument& document, QObject* parent = nullptr);
    ~LitLayer() override;

    /// Whether the project has the layer, and Lampblack made it.
    bool exists() const;

    /// Replace the layer by these PNG files, keyed by frame. The project is backed up before its first layer.
    /// With `hideSources` the lit layers are hidden afterwards. Ends with delivered() or failed().
    void deliver(const QMap<int, QString>& pictures, bool hideSources);

    /// Whether the layer was delivered after the project was last saved.
    bool isUnsaved() const { return mUnsaved; }

Q_SIGNALS:
    void delivered();
    void failed(const lampblack::UserError& error);

private:
    void onBackupDone(const QString& project, const QString& error);
    void onLayerDelivered();
    void reportFailure(const UserError& error);

    Host& mHost;
    SceneDocument& mDocument;
    QThreadPool mCopyThread;
    QSet<QString> mBackedUp; ///< paths of the projects that this session has backed up
    QMap<int, QString> mPictures;
    bool mHideSources = false;
    bool mUnsaved = false;
    bool mDelivering = false;
};

} // namespace lampblack
