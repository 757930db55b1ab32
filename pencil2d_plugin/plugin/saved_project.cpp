#include "plugin/saved_project.h"

#include "scene/layer_roles.h"

namespace lampblack
{

SavedProject::SavedProject(Host& host, SceneDocument& document, QObject* parent)
    : QObject(parent), mHost(host), mDocument(document)
{
    const auto readLayers = [this]
    {
        if (!mHost.layers().isEmpty())
            mSaved = mHost.layers();
    };
    connect(&host, &Host::projectOpened, this, [this] { mSaved.reset(); });
    connect(&host, &Host::projectSaved, this, readLayers);
    connect(&host, &Host::layersChanged, this,
            [this, readLayers]
            {
                // The layers of a project that was just opened are known a moment later.
                if (!mSaved)
                    readLayers();
            });
}

QString SavedProject::path() const
{
    const QString path = mHost.projectPath();
    const bool isShown = path.endsWith(QLatin1String(".pclx")) && !mHost.isModified() && mSaved &&
                         drawnLayers(*mSaved) == drawnLayers(mHost.layers());
    return isShown ? path : QString();
}

QStringList SavedProject::drawnLayers(const QVector<Layer>& layers) const
{
    const LayerRoles roles = mDocument.layerRoles();
    QStringList drawn;
    for (const Layer& layer : layers)
    {
        if (isResult(layer.name, roles))
            continue;
        const bool isHidden = !layer.visible && !roles.contains(layer.name);
        drawn.append(layer.name + (isHidden ? QStringLiteral(" hidden") : QString()));
    }
    return drawn;
}

} // namespace lampblack
