// The result layers: rendered frames as layers of the project.
#pragma once

#include "host/host.h"
#include "scene/scene_document.h"

#include <QMap>
#include <QSet>
#include <QThreadPool>

namespace lampblack
{

/// Pictures of one layer: PNG files by frame.
struct LayerPictures
{
    QString name;
    QMap<int, QString> pictures;
};

/// The lit frames are one layer, "Lit", or several that show the same together: "Lit: shade" and so on. Only
/// one of both is in sight.
class LitLayer : public QObject
{
    Q_OBJECT

public:
    LitLayer(Host& host, SceneDocument& document, QObject* parent = nullptr);
    ~LitLayer() override;

    /// Whether the project has such a layer, and Lampblack made it.
    bool exists() const { return exists(false) || exists(true); }
    /// Whether it has the one layer, or those that it is taken apart into.
    bool exists(bool apart) const;
    /// Whether the layers that the artist sees are those taken apart.
    bool isApart() const;

    /// Replace the layer by the pictures, or the layers that it is taken apart into, lowest first. Of these,
    /// new ones in which nothing is drawn are left out. The project is backed up before its first layer. With
    /// `hideSources` the lit layers are hidden afterwards. Ends with delivered() or failed().
    void deliver(const QVector<LayerPictures>& layers, bool hideSources);

    /// Whether a layer was delivered after the project was last saved.
    bool isUnsaved() const { return mUnsaved; }

Q_SIGNALS:
    void delivered();
    void failed(const lampblack::UserError& error);

private:
    bool isOurs(const QString& name) const;
    void prepare(const QString& project);
    void onPrepared(const QString& project, const QString& error, const QVector<LayerPictures>& layers);
    void deliverNext();
    void onLayerDelivered();
    void reportFailure(const UserError& error);

    Host& mHost;
    SceneDocument& mDocument;
    QThreadPool mFiles;      ///< reads and copies files
    QSet<QString> mBackedUp; ///< paths of the projects that this session has backed up
    QVector<LayerPictures> mLayers;
    int mDone = 0; ///< of these
    bool mHideSources = false;
    bool mUnsaved = false;
    bool mDelivering = false;
};

/// The pictures of the layers that lit frames are taken apart into, lowest first, given the lit frames: they
/// lie in folders beside them.
QVector<LayerPictures> picturesApart(const QMap<int, QString>& lit);

} // namespace lampblack
