#include "tool/panel/layers_section.h"

#include "scene/layer_roles.h"
#include "tool/panel/elided_label.h"
#include "tool/panel/ignore_wheel.h"

#include <QComboBox>
#include <QGridLayout>
#include <QLabel>

#include <algorithm>

namespace lampblack
{

namespace
{
const QString Character = QStringLiteral("character");
}

LayersSection::LayersSection(Host& host, SceneDocument& document, QWidget* parent)
    : Section(QStringLiteral("lampblack.panel.layers"), tr("Layers"), false, parent), mHost(host),
      mDocument(document)
{
    setVisible(host.can(Host::Ability::Layers));
    connect(&host, &Host::layersChanged, this, &LayersSection::refresh);
    connect(&document, &SceneDocument::layerRolesChanged, this, &LayersSection::refresh);
    connect(&document, &SceneDocument::sceneChanged, this,
            [this]
            {
                if (mDocument.scene().depth.layers != mShownDepth.layers)
                    refresh();
            });
    refresh();
}

void LayersSection::refresh()
{
    // deleteLater(), because a signal of one of these rows may have caused the refresh.
    if (mRows != nullptr)
    {
        mRows->hide();
        mRows->setParent(nullptr);
        mRows->deleteLater();
    }
    mRows = new QWidget(this);
    mRows->setFont(font());
    auto* grid = new QGridLayout(mRows);
    grid->setContentsMargins(0, 0, 0, 0);
    grid->setSpacing(3);
    grid->setColumnStretch(0, 1);
    mShownDepth = mDocument.scene().depth;
    const QMap<QString, QString> roles = mDocument.layerRoles();
    QStringList drawn;
    const QVector<Layer> layers = mHost.layers();
    for (const Layer& layer : layers)
    {
        const bool isDrawing = layer.kind == Layer::Kind::Bitmap || layer.kind == Layer::Kind::Vector;
        if (isDrawing && !isResult(layer.name, roles))
            drawn.append(layer.name);
    }
    const auto isLit = [&roles](const QString& layer)
    {
        return roleOf(layer, roles) != QLatin1String("background");
    };
    const auto lowest = std::find_if(drawn.rbegin(), drawn.rend(), isLit);
    int row = 0;
    for (const QString& layer : qAsConst(drawn))
    {
        grid->addWidget(nameLabel(layer), row, 0);
        grid->addWidget(roleChoice(layer, roleOf(layer, roles)), row++, 1);
        if (isLit(layer) && layer != *lowest) // below which there is nothing to stand on
            grid->addWidget(bodyChoice(layer), row++, 0, 1, 2);
    }
    body()->addWidget(mRows);
}

QWidget* LayersSection::nameLabel(const QString& layer)
{
    auto* name = new ElidedLabel(layer, mRows);
    name->setObjectName(QStringLiteral("lampblack.panel.layer_name.") + layer);
    return name;
}

QWidget* LayersSection::roleChoice(const QString& layer, const QString& role)
{
    auto* choice = new QComboBox(mRows);
    choice->setObjectName(QStringLiteral("lampblack.panel.layer.") + layer);
    choice->setAccessibleName(tr("Role of layer %1").arg(layer));
    choice->setToolTip(tr("Characters and their lines are lit; a background stays as drawn."));
    choice->addItem(tr("Character"), Character);
    choice->addItem(tr("Line"), QStringLiteral("line"));
    choice->addItem(tr("Background"), QStringLiteral("background"));
    choice->setCurrentIndex(qMax(0, choice->findData(role)));
    ignoreWheelWithoutFocus(choice);
    connect(choice, qOverload<int>(&QComboBox::activated), this,
            [this, layer, choice](int index) { setRole(layer, choice->itemData(index).toString()); });
    return choice;
}

QWidget* LayersSection::bodyChoice(const QString& layer)
{
    auto* choice = new QComboBox(mRows);
    choice->setObjectName(QStringLiteral("lampblack.panel.body.") + layer);
    choice->setAccessibleName(tr("Depth of layer %1").arg(layer));
    choice->setToolTip(tr("How this layer is joined to the layers below it.\nAutomatic: Lampblack decides "
                          "from the drawings.\nIn front: a round body of its own. It throws a shadow on what "
                          "is below.\nSame body: one round body together with the layer below.\nPainted on: "
                          "flat on the layer below, such as a pattern."));
    const auto add = [choice](const QString& text, BodyChoice body)
    {
        choice->addItem(text, int(body));
    };
    add(tr("Depth: automatic"), BodyChoice::Auto);
    add(tr("Depth: in front"), BodyChoice::Own);
    add(tr("Depth: same body"), BodyChoice::Below);
    add(tr("Depth: painted on"), BodyChoice::Flat);
    choice->setCurrentIndex(qMax(0, choice->findData(int(bodyOf(mDocument.scene(), layer)))));
    choice->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
    ignoreWheelWithoutFocus(choice);
    connect(choice, qOverload<int>(&QComboBox::activated), this,
            [this, layer, choice](int index)
            {
                const auto body = static_cast<BodyChoice>(choice->itemData(index).toInt());
                mDocument.edit(tr("Change Layer Depth"), withBody(mDocument.scene(), layer, body));
            });
    return choice;
}

void LayersSection::setRole(const QString& layer, const QString& role)
{
    // Give every layer a role: as soon as one has a role, layers without one are backgrounds.
    const LayerRoles before = mDocument.layerRoles();
    LayerRoles roles = before;
    const QVector<Layer> layers = mHost.layers();
    for (const Layer& each : layers)
    {
        const bool isDrawing = each.kind == Layer::Kind::Bitmap || each.kind == Layer::Kind::Vector;
        if (isDrawing && !isResult(each.name, before))
            roles.insert(each.name, roleOf(each.name, before));
    }
    roles.insert(layer, role);
    mDocument.setLayerRoles(roles);
}

BodyChoice bodyOf(const Scene& scene, const QString& layer)
{
    const QVector<LayerBody>& bodies = scene.depth.layers;
    const auto* found = std::find_if(bodies.begin(), bodies.end(),
                                     [&layer](const LayerBody& body) { return body.layer == layer; });
    return found == bodies.end() ? BodyChoice::Auto : found->body;
}

Scene withBody(Scene scene, const QString& layer, BodyChoice body)
{
    QVector<LayerBody>& bodies = scene.depth.layers;
    auto* found = std::find_if(bodies.begin(), bodies.end(),
                               [&layer](const LayerBody& each) { return each.layer == layer; });
    if (found != bodies.end())
        found->body = body;
    else if (body != BodyChoice::Auto)
        bodies.append({layer, body, {}});
    return scene;
}

} // namespace lampblack
