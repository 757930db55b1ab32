#include "plugin/lit_layer.h"

#include "plugin/backup.h"
#include "plugin/layer_stack.h"
#include "protocol/generated/apart_layers.h"

#include <QFileInfo>
#include <QImage>

#include <algorithm>

namespace lampblack
{

namespace
{

const QString Result = QStringLiteral("result");
const QString Character = QStringLiteral("character");

bool isBlank(const QString& picture)
{
    const QImage image = QImage(picture).convertToFormat(QImage::Format_ARGB32);
    for (int y = 0; y < image.height(); ++y)
    {
        const auto* pixels = reinterpret_cast<const QRgb*>(image.constScanLine(y));
        if (std::any_of(pixels, pixels + image.width(), [](QRgb pixel) { return qAlpha(pixel) != 0; }))
            return false;
    }
    return true;
}

QStringList namesOf(bool apart)
{
    if (!apart)
        return {resultLayer()};
    QStringList names;
    for (const char* name : protocol::ApartLayers)
        names << resultLayer(QLatin1String(name));
    return names;
}

} // namespace

QVector<LayerPictures> picturesApart(const QMap<int, QString>& lit)
{
    QVector<LayerPictures> layers;
    for (const char* name : protocol::ApartLayers)
    {
        LayerPictures layer{resultLayer(QLatin1String(name)), {}};
        for (auto frame = lit.begin(); frame != lit.end(); ++frame)
        {
            const QFileInfo file(frame.value());
            const QString picture =
                QStringLiteral("%1/%2/%3").arg(file.path(), QLatin1String(name), file.fileName());
            if (QFileInfo::exists(picture))
                layer.pictures.insert(frame.key(), picture);
        }
        layers << layer;
    }
    return layers;
}

LitLayer::LitLayer(Host& host, SceneDocument& document, QObject* parent)
    : QObject(parent), mHost(host), mDocument(document)
{
    mFiles.setMaxThreadCount(1);
    connect(&host, &Host::layerDelivered, this, &LitLayer::onLayerDelivered);
    connect(&host, &Host::layerFailed, this, &LitLayer::reportFailure);
    connect(&host, &Host::projectSaved, this, [this] { mUnsaved = false; });
    connect(&host, &Host::projectOpened, this,
            [this]
            {
                mUnsaved = false;
                mDelivering = false;
            });
}

LitLayer::~LitLayer()
{
    mFiles.waitForDone();
}

bool LitLayer::isOurs(const QString& name) const
{
    return mDocument.layerRoles().value(name) == Result;
}

bool LitLayer::exists(bool apart) const
{
    const QStringList names = namesOf(apart);
    const QVector<Layer> layers = mHost.layers();
    return std::any_of(layers.begin(), layers.end(),
                       [&](const Layer& layer) { return names.contains(layer.name) && isOurs(layer.name); });
}

bool LitLayer::isApart() const
{
    const QVector<Layer> layers = mHost.layers();
    const bool isWhole =
        std::any_of(layers.begin(), layers.end(),
                    [](const Layer& layer) { return layer.visible && layer.name == resultLayer(); });
    return exists(true) && !(exists(false) && isWhole);
}

void LitLayer::deliver(const QVector<LayerPictures>& layers, bool hideSources)
{
    mLayers = layers;
    mDone = 0;
    mHideSources = hideSources;
    mDelivering = true;
    const QVector<Layer> before = mHost.layers();
    for (const LayerPictures& layer : layers)
    {
        const bool isThere = std::any_of(before.begin(), before.end(),
                                         [&](const Layer& each) { return each.name == layer.name; });
        if (isThere && !isOurs(layer.name))
        {
            reportFailure({tr("The project has a layer \"%1\" that Lampblack did not make.").arg(layer.name),
                           tr("Rename it or delete it, then render again."),
                           {}});
            return;
        }
    }
    prepare(mHost.projectPath());
}

void LitLayer::prepare(const QString& project)
{
    QStringList present;
    const QVector<Layer> before = mHost.layers();
    for (const Layer& layer : before)
        present << layer.name;
    const bool isBackedUp = mBackedUp.contains(project);
    mFiles.start(
        [this, project, isBackedUp, present, layers = mLayers]
        {
            const QString error = isBackedUp ? QString() : backUpProject(project);
            QVector<LayerPictures> drawn;
            for (const LayerPictures& layer : layers)
            {
                // What was there and is blank now must go from sight as well.
                if (layers.size() == 1 || present.contains(layer.name) ||
                    !std::all_of(layer.pictures.begin(), layer.pictures.end(), isBlank))
                    drawn << layer;
            }
            if (drawn.isEmpty())
                drawn << layers.first();
            QMetaObject::invokeMethod(
                this, [this, project, error, drawn] { onPrepared(project, error, drawn); },
                Qt::QueuedConnection);
        });
}

void LitLayer::onPrepared(const QString& project, const QString& error, const QVector<LayerPictures>& layers)
{
    if (!mDelivering || project != mHost.projectPath())
        return;
    if (!error.isEmpty())
    {
        reportFailure({tr("The project could not be backed up, so the layer was not added."),
                       tr("Check that there is space on the disk, and that you may write to the folder of "
                          "the project."),
                       error});
        return;
    }
    mBackedUp.insert(project);
    mLayers = layers;
    deliverNext();
}

void LitLayer::deliverNext()
{
    // Each goes on top of those before it.
    mHost.deliverLayer(mLayers[mDone].name, mLayers[mDone].pictures);
}

void LitLayer::onLayerDelivered()
{
    if (!mDelivering)
        return;
    mUnsaved = true;
    LayerRoles roles = mDocument.layerRoles();
    roles.insert(mLayers[mDone].name, Result);
    const bool isLast = ++mDone == mLayers.size();
    const QStringList sources = sortLayers(mHost.layers(), roles).lit;
    if (isLast && mHideSources)
    {
        // A hidden layer is lit only if it has a role, see sortLayers().
        for (const QString& source : sources)
        {
            if (!roles.contains(source))
                roles.insert(source, Character);
        }
    }
    mDocument.setLayerRoles(roles);
    if (!isLast)
    {
        deliverNext();
        return;
    }
    mDelivering = false;
    const bool wasApart = mLayers.first().name != resultLayer();
    QStringList hidden = mHideSources ? sources : QStringList();
    if (exists(!wasApart))
        hidden += namesOf(!wasApart);
    if (!hidden.isEmpty())
        mHost.hideLayers(hidden);
    Q_EMIT delivered();
}

void LitLayer::reportFailure(const UserError& error)
{
    if (!mDelivering)
        return;
    mDelivering = false;
    Q_EMIT failed(error);
}

} // namespace lampblack
