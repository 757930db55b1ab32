#include "tool/panel/light_numbers.h"

#include "scene/temperature.h"
#include "scene/timeline.h"
#include "tool/panel/light_links.h"
#include "tool/panel/section.h"

#include <QHBoxLayout>
#include <QToolButton>

#include <cmath>

namespace lampblack
{

namespace
{

constexpr double MaxPower = 20;
constexpr double KelvinStep = 50;

// `unit` is half the canvas's long side. Lights that are farther away hardly differ.
SliderScale heightScale(double unit)
{
    return {-4 * unit, 4 * unit, 2 * unit, 2, true, 0};
}

SliderScale sizeScale(double unit)
{
    return {1, 4 * unit, 2 * unit, 2, false, 0};
}

SliderScale warmthScale()
{
    return {WarmestKelvin, ColdestKelvin, ColdestKelvin, 2, false, 0, WarmestKelvin};
}

QString named(const char* name)
{
    return QStringLiteral("lampblack.panel.") + QLatin1String(name);
}

} // namespace

LightNumbers::LightNumbers(Host& host, SceneDocument& document, QWidget* parent)
    : QWidget(parent), mHost(host), mDocument(document), mKind(new QButtonGroup(this))
{
    addRows();
    connectRows();
    connect(mKeys, &KeysRow::keyToggled, this, &LightNumbers::toggleKey);
    connect(&host, &Host::frameChanged, this,
            [this]
            {
                if (isKeyed(mDocument.scene()))
                    refresh();
            });
    connect(&document, &SceneDocument::sceneChanged, this, &LightNumbers::refresh);
    connect(&document, &SceneDocument::selectionChanged, this, &LightNumbers::refresh);
    refresh();
}

QWidget* LightNumbers::kindAndColour()
{
    auto* box = new QWidget(this);
    auto* row = new QHBoxLayout(box);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(0);
    const auto add = [&](LightKind kind, const char* name, const QString& text, const QString& hint)
    {
        auto* button = new QToolButton(box);
        button->setObjectName(named(name));
        button->setText(text);
        button->setToolTip(hint);
        button->setCheckable(true);
        button->setFocusPolicy(Qt::StrongFocus);
        mKind->addButton(button, int(kind));
        row->addWidget(button);
    };
    add(LightKind::Lamp, "lamp", tr("Lamp"), tr("A light that is near: far from it, the drawing is darker"));
    add(LightKind::Sun, "sun", tr("Sun"),
        tr("A light that is far away: it lights the whole drawing equally, from its place towards the "
           "middle"));
    mColour = new ColourButton(named("colour"), tr("Colour of the light"), box);
    row->addStretch(1);
    row->addWidget(mColour);
    return box;
}

void LightNumbers::addRows()
{
    const double unit = defaultHeight(mDocument.scene().canvas);
    auto* rows = new QVBoxLayout(this);
    rows->setContentsMargins(0, 0, 0, 0);
    rows->setSpacing(3);
    rows->addWidget(kindAndColour());
    const auto add =
        [&](const char* name, const QString& label, const SliderScale& scale, const QString& hint)
    {
        auto* row = new ValueRow(named(name), label, scale, this);
        row->setHint(hint);
        rows->addWidget(row);
        return row;
    };
    mWarmth = add("warmth", tr("Warmth"), warmthScale(),
                  tr("Temperature of the colour, in kelvin: 1900 is a candle, 3000 a lamp, 5500 sunlight, "
                     "10000 a blue sky"));
    mPower = add("power", tr("Power"), {0, MaxPower, 10, 4, false, 2},
                 tr("Brightness. With 1, at the default height, you see the colours as drawn."));
    mSize = add("size", tr("Size"), sizeScale(unit), tr("Diameter. A large light makes soft shadows."));
    mHeight = add("height", tr("Height"), heightScale(unit),
                  tr("Height above the paper. Below 0 the light is behind the paper, and lights only edges "
                     "that turn away from you. For a line of light, use the rim of the look."));
    mKeys = new KeysRow(named("keys"), mHost, this);
    rows->addWidget(mKeys);
    rows->addWidget(more());
}

QWidget* LightNumbers::more()
{
    auto* section = new Section(named("light.more"), tr("More"), false, this);
    section->body()->setContentsMargins(0, 0, 0, 0); // in line with the rows above
    mPlace = new PlaceRow(named("place"), tr("Place"), this);
    section->body()->addWidget(mPlace);
    mShadow = new QCheckBox(tr("Casts shadows"), this);
    mShadow->setObjectName(named("light.shadow"));
    mShadow->setToolTip(tr("Without shadows: a fill light, which shines through the character"));
    section->body()->addWidget(mShadow);
    section->body()->addWidget(new LightLinks(mHost, mDocument, this));
    return section;
}

void LightNumbers::connectRows()
{
    connect(mKind, &QButtonGroup::idClicked, this,
            [this](int kind)
            {
                changeForGood(kind == int(LightKind::Sun) ? tr("Make a Sun") : tr("Make a Lamp"),
                              [kind](AreaLight& light) { light.kind = static_cast<LightKind>(kind); });
            });
    connect(mShadow, &QCheckBox::clicked, this,
            [this](bool casts)
            {
                changeForGood(casts ? tr("Cast Shadows") : tr("Cast No Shadows"),
                              [casts](AreaLight& light) { light.castsShadow = casts; });
            });
    const auto setColour = [this](const QColor& colour, int gesture)
    {
        changeLight(tr("Change Light Colour"), gesture, [&](AreaLight& light) { light.colour = colour; });
    };
    connect(mColour, &ColourButton::edited, this, setColour);
    connect(mWarmth, &ValueRow::edited, this,
            [setColour](double kelvin, int gesture) { setColour(colourOfKelvin(kelvin), gesture); });
    connect(mPlace, &PlaceRow::edited, this,
            [this](const QPointF& place, int gesture)
            {
                changeLight(tr("Move Light"), gesture,
                            [&](AreaLight& light)
                            {
                                light.x = place.x();
                                light.y = place.y();
                            });
            });
    const auto bind = [this](ValueRow* row, const QString& text, double AreaLight::*field)
    {
        connect(row, &ValueRow::edited, this,
                [this, text, field](double value, int gesture)
                { changeLight(text, gesture, [&](AreaLight& light) { light.*field = value; }); });
    };
    bind(mPower, tr("Change Light Power"), &AreaLight::power);
    bind(mSize, tr("Change Light Size"), &AreaLight::size);
    bind(mHeight, tr("Change Light Height"), &AreaLight::z);
}

void LightNumbers::refresh()
{
    Scene scene = mDocument.scene();
    const AreaLight* selected = selectedIn(scene);
    setEnabled(selected != nullptr);
    if (selected == nullptr)
        return;
    const AreaLight light = lightAt(*selected, mHost.currentFrame());
    const double unit = defaultHeight(scene.canvas);
    mKind->button(int(light.kind))->setChecked(true);
    mColour->setColour(light.colour);
    mWarmth->setValue(KelvinStep * std::round(kelvinOfColour(light.colour) / KelvinStep));
    mSize->setScale(sizeScale(unit));
    mHeight->setScale(heightScale(unit));
    mPower->setValue(light.power);
    mSize->setValue(light.size);
    mHeight->setValue(light.z);
    mPlace->setPlace({light.x, light.y});
    mShadow->setChecked(light.castsShadow);
    mKeys->setKeys(keyFrames(*selected));
}

AreaLight* LightNumbers::selectedIn(Scene& scene) const
{
    const int selected = mDocument.selectedLight();
    return selected < 0 || selected >= scene.lights.size() ? nullptr : &scene.lights[selected];
}

void LightNumbers::changeLight(const QString& text, int gesture, const std::function<void(AreaLight&)>& apply)
{
    Scene scene = mDocument.scene();
    AreaLight* light = selectedIn(scene);
    if (light == nullptr)
        return;
    const int frame = mHost.currentFrame();
    AreaLight shown = lightAt(*light, frame);
    apply(shown);
    *light = changedAt(*light, frame, shown);
    mDocument.edit(text, scene, gesture);
}

void LightNumbers::changeForGood(const QString& text, const std::function<void(AreaLight&)>& apply)
{
    Scene scene = mDocument.scene();
    AreaLight* light = selectedIn(scene);
    if (light == nullptr)
        return;
    apply(*light);
    mDocument.edit(text, scene);
}

void LightNumbers::toggleKey()
{
    const int frame = mHost.currentFrame();
    Scene scene = mDocument.scene();
    AreaLight* light = selectedIn(scene);
    if (light == nullptr)
        return;
    const bool hasKey = keyFrames(*light).contains(frame);
    *light = hasKey ? withoutKey(*light, frame) : withKey(*light, frame);
    mDocument.edit(hasKey ? tr("Remove Key") : tr("Add Key"), scene);
}

} // namespace lampblack
