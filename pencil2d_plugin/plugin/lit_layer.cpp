#include "plugin/lit_layer.h"

#include "plugin/backup.h"
#include "plugin/layer_stack.h"

#include <algorithm>

namespace lampblack
{

namespace
{

const QString Name = resultLayer();
const QString Result = QStringLiteral("result");
const QString Character = QStringLiteral("character");

} // namespace

LitLayer::LitLayer(Host& host, SceneDocument& document, QObject* parent)
    : QObject(parent), mHost(host), mDocument(document)
{
    mCopyThread.setMaxThreadCount(1);
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
    mCopyThread.waitForDone();
}

bool LitLayer::exists() const
{
    const QVector<Layer> layers = mHost.layers();
    return mDocument.layerRoles().value(Name) == Result &&
           std::any_of(layers.begin(), layers.end(), [](const Layer& layer) { return layer.name == Name; });
}

void LitLayer::deliver(const QMap<int, QString>& pictures, bool hideSources)
{
    mPictures = pictures;
    mHideSources = hideSources;
    mDelivering = true;
    const QVector<Layer> layers = mHost.layers();
    const bool hasLayer =
        std::any_of(layers.begin(), layers.end(), [](const Layer& layer) { return layer.name == Name; });
    if (hasLayer && !exists())
    {
        reportFailure({tr("The project has a layer \"%1\" that Lampblack did not make.").arg(Name),
                       tr("Rename it or delete it, then render again."),
                       {}});
        return;
    }
    const QString project = mHost.projectPath();
    if (mBackedUp.contains(project))
    {
        onBackupDone(project, {});
        return;
    }
    mCopyThread.start(
        [this, project]
        {
            const QString error = backUpProject(project);
            QMetaObject::invokeMethod(
                this, [this, project, error] { onBackupDone(project, error); }, Qt::QueuedConnection);
        });
}

void LitLayer::onBackupDone(const QString& project, const QString& error)
{
    if (!mDelivering || project != mHost.projectPath())
        return;
    if (!error.isEmpty())
    {
        reportFailure({tr("The project could not be backed up, so no layer was put into it."),
                       tr("See that there is space and that you may write beside the project."), error});
        return;
    }
    mBackedUp.insert(project);
    mHost.deliverLayer(Name, mPictures);
}

void LitLayer::onLayerDelivered()
{
    if (!mDelivering)
        return;
    mDelivering = false;
    mUnsaved = true;
    LayerRoles roles = mDocument.layerRoles();
    const QStringList sources = sortLayers(mHost.layers(), roles).lit;
    roles.insert(Name, Result);
    if (mHideSources)
    {
        // A hidden layer is lit only if it has a role, see sortLayers().
        for (const QString& source : sources)
        {
            if (!roles.contains(source))
                roles.insert(source, Character);
        }
    }
    mDocument.setLayerRoles(roles);
    if (mHideSources)
        mHost.hideLayers(sources);
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
