#include "tool/panel/light_links.h"

#include "scene/layer_roles.h"
#include "scene/timeline.h"
#include "tool/canvas/lamp_menu.h"

#include <QActionGroup>
#include <QHBoxLayout>
#include <QLabel>
#include <QVBoxLayout>

namespace lampblack
{

namespace
{
constexpr int SwatchSide = 14;
constexpr int MostTextWidth = 84; ///< of a button, pixels: the panel is narrow
} // namespace

LightLinks::LightLinks(Host& host, SceneDocument& document, QWidget* parent)
    : QWidget(parent), mHost(host), mDocument(document)
{
    auto* rows = new QVBoxLayout(this);
    rows->setContentsMargins(0, 0, 0, 0);
    rows->setSpacing(3);
    mLitLayers = addChoice("light.layers", tr("Lights layers"),
                           tr("This light lights only these layers: for example the face, but not the hills"),
                           [this](QMenu& menu) { fillLit(menu, layers(), &AreaLight::layers); });
    mLitColours = addChoice("light.colours", tr("Lights colours"),
                            tr("This light lights only these colours: for example the eyes"),
                            [this](QMenu& menu) { fillLit(menu, mColours, &AreaLight::colours); });
    mPinned = addChoice("light.pin", tr("Moves with"),
                        tr("The light moves with a place of the drawing, such as a lantern in a hand, or "
                           "with a layer, from frame to frame"),
                        [this](QMenu& menu) { fillPins(menu); });
    connect(&document, &SceneDocument::sceneChanged, this, &LightLinks::refresh);
    connect(&document, &SceneDocument::selectionChanged, this, &LightLinks::refresh);
    refresh();
}

QToolButton* LightLinks::addChoice(const char* name, const QString& label, const QString& hint,
                                   const std::function<void(QMenu&)>& fill)
{
    auto* button = new QToolButton(this);
    button->setObjectName(QStringLiteral("lampblack.panel.") + QLatin1String(name));
    button->setToolTip(hint);
    button->setAccessibleName(label);
    button->setPopupMode(QToolButton::InstantPopup);
    button->setFocusPolicy(Qt::StrongFocus);
    auto* menu = new QMenu(button);
    button->setMenu(menu);
    connect(menu, &QMenu::aboutToShow, this,
            [menu, fill]
            {
                menu->clear();
                fill(*menu);
            });
    auto* row = new QHBoxLayout;
    row->addWidget(new QLabel(label, this));
    row->addStretch(1);
    row->addWidget(button);
    static_cast<QVBoxLayout*>(layout())->addLayout(row);
    return button;
}

void LightLinks::fillLit(QMenu& menu, const QStringList& all, QStringList AreaLight::*field)
{
    const AreaLight* light = selected();
    if (light == nullptr)
        return;
    const QStringList chosen = light->*field;
    QAction* everything = menu.addAction(tr("All"));
    everything->setCheckable(true);
    everything->setChecked(chosen.isEmpty());
    connect(everything, &QAction::triggered, this,
            [this, field] { change(tr("Light All"), [field](AreaLight& each) { (each.*field).clear(); }); });
    menu.addSeparator();
    QStringList names = all;
    for (const QString& name : chosen) // also those that are not in this frame
        if (!names.contains(name))
            names << name;
    for (const QString& name : qAsConst(names))
    {
        QAction* entry = menu.addAction(name);
        entry->setCheckable(true);
        entry->setChecked(chosen.contains(name));
        if (field == &AreaLight::colours)
            entry->setIcon(colourIcon(QColor(name), SwatchSide, devicePixelRatioF()));
        connect(entry, &QAction::triggered, this,
                [this, field, name](bool on)
                {
                    change(tr("Change What a Light Lights"),
                           [&](AreaLight& each)
                           {
                               (each.*field).removeAll(name);
                               if (on)
                                   (each.*field) << name;
                           });
                });
    }
}

void LightLinks::fillPins(QMenu& menu)
{
    const AreaLight* light = selected();
    if (light == nullptr)
        return;
    auto* choices = new QActionGroup(&menu);
    const auto add = [&](const QString& text, bool on, const std::function<void()>& choose)
    {
        QAction* entry = menu.addAction(text);
        entry->setCheckable(true);
        entry->setChecked(on);
        choices->addAction(entry);
        connect(entry, &QAction::triggered, this, choose);
    };
    const QString layer = light->pin ? light->pin->layer : QString();
    add(tr("Nothing"), !light->pin, [this] { unpin(); });
    add(tr("What Is Beneath It Here"), light->pin && layer.isEmpty(), [this] { pinTo(QString()); });
    menu.addSeparator();
    QStringList names = layers();
    if (!layer.isEmpty() && !names.contains(layer))
        names << layer;
    for (const QString& name : qAsConst(names))
        add(name, name == layer, [this, name] { pinTo(name); });
}

QStringList LightLinks::layers() const
{
    QStringList names;
    const LayerRoles roles = mDocument.layerRoles();
    const QVector<Layer> all = mHost.layers();
    for (const Layer& layer : all)
    {
        const bool isDrawing = layer.kind == Layer::Kind::Bitmap || layer.kind == Layer::Kind::Vector;
        if (isDrawing && !isResult(layer.name, roles) && !isLight(layer.name, roles))
            names << layer.name;
    }
    return names;
}

void LightLinks::refresh()
{
    const AreaLight* light = selected();
    const auto say = [](const QStringList& chosen)
    {
        return chosen.isEmpty() ? tr("all") : tr("%1 chosen").arg(chosen.size());
    };
    mLitLayers->setText(say(light ? light->layers : QStringList()));
    mLitColours->setText(say(light ? light->colours : QStringList()));
    const auto pinned = [&]
    {
        if (light == nullptr || !light->pin)
            return tr("nothing");
        return light->pin->layer.isEmpty() ? tr("its place") : light->pin->layer;
    };
    mPinned->setText(fontMetrics().elidedText(pinned(), Qt::ElideRight, MostTextWidth));
    mPinned->setEnabled(light != nullptr && light->kind == LightKind::Lamp);
}

void LightLinks::unpin()
{
    change(tr("Unpin Light"), [](AreaLight& light) { light.pin.reset(); });
}

void LightLinks::pinTo(const QString& layer)
{
    const int frame = mHost.currentFrame();
    change(tr("Pin Light"),
           [&](AreaLight& light)
           {
               const AreaLight shown = lightAt(light, frame);
               Pin pin;
               pin.frame = frame;
               pin.x = shown.x;
               pin.y = shown.y;
               pin.layer = layer;
               light.pin = pin;
           });
}

void LightLinks::change(const QString& text, const std::function<void(AreaLight&)>& apply)
{
    Scene scene = mDocument.scene();
    if (selected() == nullptr)
        return;
    apply(scene.lights[mDocument.selectedLight()]);
    mDocument.edit(text, scene);
}

const AreaLight* LightLinks::selected() const
{
    const int light = mDocument.selectedLight();
    const QVector<AreaLight>& lights = mDocument.scene().lights;
    return light < 0 || light >= lights.size() ? nullptr : &lights[light];
}

} // namespace lampblack
