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
    mCopier.setMaxThreadCount(1);
    connect(&host, &Host::layerDelivered, this, &LitLayer::settle);
    connect(&host, &Host::layerFailed, this, &LitLayer::fail);
    connect(&host, &Host::projectSaved, this, [this] { mUnsaved = false; });
    connect(&host, &Host::projectOpened, this,
            [this]
            {
                mUnsaved = false;
                mAtWork = false;
            });
}

LitLayer::~LitLayer()
{
    mCopier.waitForDone();
}

bool LitLayer::isThere() const
{
    const QVector<Layer> layers = mHost.layers();
    return mDocument.layerRoles().value(Name) == Result &&
           std::any_of(layers.begin(), layers.end(), [](const Layer& layer) { return layer.name == Name; });
}

void LitLayer::deliver(const QMap<int, QString>& pictures, bool hideSources)
{
    mPictures = pictures;
    mHideSources = hideSources;
    mAtWork = true;
    const QVector<Layer> layers = mHost.layers();
    const bool taken =
        std::any_of(layers.begin(), layers.end(), [](const Layer& layer) { return layer.name == Name; });
    if (taken && !isThere())
    {
        fail({tr("The project has a layer \"%1\" that Lampblack did not make.").arg(Name),
              tr("Rename it or delete it, then render again."),
              {}});
        return;
    }
    const QString project = mHost.projectPath();
    if (mBackedUp.contains(project))
    {
        afterBackup(project, {});
        return;
    }
    mCopier.start(
        [this, project]
        {
            const QString fault = backUp(project);
            QMetaObject::invokeMethod(
                this, [this, project, fault] { afterBackup(project, fault); }, Qt::QueuedConnection);
        });
}

void LitLayer::afterBackup(const QString& project, const QString& fault)
{
    if (!mAtWork || project != mHost.projectPath())
        return;
    if (!fault.isEmpty())
    {
        fail({tr("The project could not be backed up, so no layer was put into it."),
              tr("See that there is space and that you may write beside the project."), fault});
        return;
    }
    mBackedUp.insert(project);
    mHost.deliverLayer(Name, mPictures);
}

void LitLayer::settle()
{
    if (!mAtWork)
        return;
    mAtWork = false;
    mUnsaved = true;
    LayerRoles roles = mDocument.layerRoles();
    const QStringList sources = stackLayers(mHost.layers(), roles).lit;
    roles.insert(Name, Result);
    if (mHideSources)
    {
        // A role keeps a hidden layer among the sources.
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

void LitLayer::fail(const UserError& error)
{
    if (!mAtWork)
        return;
    mAtWork = false;
    Q_EMIT failed(error);
}

} // namespace lampblack
