#include "tool/panel/layers_section.h"

#include "scene/layer_roles.h"
#include "tool/panel/ignore_wheel.h"

#include <QComboBox>
#include <QGridLayout>
#include <QLabel>

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
    auto* grid = new QGridLayout(mRows);
    grid->setContentsMargins(0, 0, 0, 0);
    grid->setSpacing(3);
    grid->setColumnStretch(0, 1);
    const QMap<QString, QString> roles = mDocument.layerRoles();
    int row = 0;
    const QVector<Layer> layers = mHost.layers();
    for (const Layer& layer : layers)
    {
        const bool isDrawing = layer.kind == Layer::Kind::Bitmap || layer.kind == Layer::Kind::Vector;
        if (!isDrawing || isResult(layer.name, roles))
            continue;
        auto* name = new QLabel(mRows);
        name->setTextFormat(Qt::PlainText);
        name->setText(layer.name);
        name->setToolTip(layer.name);
        name->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
        auto* role = new QComboBox(mRows);
        role->setObjectName(QStringLiteral("lampblack.panel.layer.") + layer.name);
        role->setAccessibleName(tr("Role of layer %1").arg(layer.name));
        role->setToolTip(tr("Characters and their lines are lit; a background stays as drawn."));
        role->addItem(tr("Character"), Character);
        role->addItem(tr("Line"), QStringLiteral("line"));
        role->addItem(tr("Background"), QStringLiteral("background"));
        role->setCurrentIndex(qMax(0, role->findData(roleOf(layer.name, roles))));
        ignoreWheelWithoutFocus(role);
        const QString layerName = layer.name;
        connect(role, qOverload<int>(&QComboBox::activated), this,
                [this, layerName, role](int index) { setRole(layerName, role->itemData(index).toString()); });
        grid->addWidget(name, row, 0);
        grid->addWidget(role, row, 1);
        ++row;
    }
    body()->addWidget(mRows);
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

} // namespace lampblack
