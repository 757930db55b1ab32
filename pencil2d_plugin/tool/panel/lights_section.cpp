#include "tool/panel/lights_section.h"

#include "scene/timeline.h"
#include "tool/canvas/key_input.h"
#include "tool/canvas/lamp_menu.h"

#include <QHBoxLayout>

#include <cmath>

namespace lampblack
{

namespace
{

constexpr double Far = 1e5; // the schema's limit of coordinates
constexpr int DiscSide = 16;

SliderScale heightScale(double unit)
{
    return {-Far, Far, 2 * unit, 2, true, 0};
}

SliderScale sizeScale(double unit)
{
    return {1, Far, 2 * unit, 2, false, 0};
}

} // namespace

QToolButton* smallButton(const QString& name, const QString& text, const QString& hint, QWidget* parent)
{
    auto* button = new QToolButton(parent);
    button->setObjectName(name);
    button->setText(text);
    button->setToolTip(hint);
    button->setAccessibleName(hint);
    button->setAutoRaise(true);
    button->setFocusPolicy(Qt::StrongFocus);
    return button;
}

LightsSection::LightsSection(Host& host, SceneDocument& document, QWidget* parent)
    : Section(QStringLiteral("lampblack.panel.lights"), tr("Lights"), true, parent), mHost(host),
      mDocument(document), mChoice(new QButtonGroup(this))
{
    auto* row = new QHBoxLayout;
    row->setSpacing(2);
    for (int light = 0; light < MaxLights; ++light)
    {
        QToolButton* button = smallButton(QStringLiteral("lampblack.panel.light.%1").arg(light + 1),
                                          QString(), tr("Light %1").arg(light + 1), this);
        button->setCheckable(true);
        button->setIconSize(QSize(DiscSide, DiscSide));
        mChoice->addButton(button, light);
        mLights[size_t(light)] = button;
        row->addWidget(button);
        connect(button, &QToolButton::clicked, this, [this, light] { mDocument.selectLight(light); });
    }
    mChoice->setExclusive(false);
    mAdd = smallButton(QStringLiteral("lampblack.panel.light.add"), QStringLiteral("+"), tr("Add a light"),
                       this);
    mDelete = smallButton(QStringLiteral("lampblack.panel.light.delete"), QStringLiteral("−"),
                          tr("Delete the selected light"), this);
    row->addStretch(1);
    row->addWidget(mAdd);
    row->addWidget(mDelete);
    connect(mAdd, &QToolButton::clicked, this, &LightsSection::addLight);
    connect(mDelete, &QToolButton::clicked, this, &LightsSection::deleteLight);
    body()->addLayout(row);

    mNumbers = new QWidget(this);
    auto* numbers = new QVBoxLayout(mNumbers);
    numbers->setContentsMargins(0, 0, 0, 0);
    numbers->setSpacing(3);
    const double unit = defaultHeight(mDocument.scene().canvas);
    auto* colourRow = new QHBoxLayout;
    mColour = new ColourButton(QStringLiteral("lampblack.panel.colour"), tr("Colour of the light"), mNumbers);
    auto* colourLabel = new QLabel(tr("Colour"), mNumbers);
    colourRow->addWidget(colourLabel);
    colourRow->addStretch(1);
    colourRow->addWidget(mColour);
    mPower = new ValueRow(QStringLiteral("lampblack.panel.power"), tr("Power"), {0, 100, 10, 4, false, 2},
                          mNumbers);
    mPower->setHint(tr("1 lights what faces it, from the usual height, to its drawn colour."));
    mSize = new ValueRow(QStringLiteral("lampblack.panel.size"), tr("Size"), sizeScale(unit), mNumbers);
    mSize->setHint(tr("Diameter. A large light makes soft shadows."));
    mHeight =
        new ValueRow(QStringLiteral("lampblack.panel.height"), tr("Height"), heightScale(unit), mNumbers);
    mHeight->setHint(tr("Above the paper; below 0 the light stands behind it and draws a rim."));
    numbers->addLayout(colourRow);
    numbers->addWidget(mPower);
    numbers->addWidget(mSize);
    numbers->addWidget(mHeight);
    mKeys = new KeysRow(QStringLiteral("lampblack.panel.keys"), host, mNumbers);
    numbers->addWidget(mKeys);
    body()->addWidget(mNumbers);

    connect(mColour, &ColourButton::edited, this,
            [this](const QColor& colour, int gesture) {
                changeLight(tr("Change Light Colour"), gesture,
                            [&](AreaLight& light) { light.colour = colour; });
            });
    connect(
        mPower, &ValueRow::edited, this,
        [this](double value, int gesture)
        { changeLight(tr("Change Light Power"), gesture, [&](AreaLight& light) { light.power = value; }); });
    connect(mSize, &ValueRow::edited, this,
            [this](double value, int gesture) {
                changeLight(tr("Change Light Size"), gesture, [&](AreaLight& light) { light.size = value; });
            });
    connect(mHeight, &ValueRow::edited, this,
            [this](double value, int gesture)
            { changeLight(tr("Change Light Height"), gesture, [&](AreaLight& light) { light.z = value; }); });
    connect(mKeys, &KeysRow::keyToggled, this, &LightsSection::toggleKey);
    connect(&host, &Host::frameChanged, this,
            [this]
            {
                if (isKeyed(mDocument.scene()))
                    refresh();
            });
    connect(&document, &SceneDocument::sceneChanged, this, &LightsSection::refresh);
    connect(&document, &SceneDocument::selectionChanged, this, &LightsSection::refresh);
    refresh();
}

void LightsSection::refresh()
{
    const Scene scene = sceneAt(mDocument.scene(), mHost.currentFrame());
    const int selected = mDocument.selectedLight();
    for (int light = 0; light < MaxLights; ++light)
    {
        QToolButton* button = mLights[size_t(light)];
        button->setVisible(light < scene.lights.size());
        button->setChecked(light == selected);
        // Only if it changes, because Qt keeps the pixmap of every icon that it has painted.
        if (light < scene.lights.size() && mDiscs[size_t(light)] != scene.lights[light].colour)
        {
            mDiscs[size_t(light)] = scene.lights[light].colour;
            button->setIcon(colourIcon(scene.lights[light].colour, DiscSide, devicePixelRatioF()));
        }
    }
    mAdd->setEnabled(scene.lights.size() < MaxLights);
    const bool hasLight = selected >= 0 && selected < scene.lights.size();
    mDelete->setEnabled(hasLight);
    mNumbers->setEnabled(hasLight);
    if (!hasLight)
        return;
    const AreaLight& light = scene.lights[selected];
    mColour->setColour(light.colour);
    mSize->setScale(sizeScale(defaultHeight(scene.canvas)));
    mHeight->setScale(heightScale(defaultHeight(scene.canvas)));
    mPower->setValue(light.power);
    mSize->setValue(light.size);
    mHeight->setValue(light.z);
    mKeys->setKeys(keyFrames(mDocument.scene().lights[selected]));
}

void LightsSection::addLight()
{
    Scene scene = mDocument.scene();
    if (scene.lights.size() >= MaxLights)
        return;
    // Each light starts at another corner, so that none hides another.
    const int corner = scene.lights.size();
    const double x = scene.canvas.width * (corner % 2 ? 0.75 : 0.25);
    const double y = scene.canvas.height * (corner / 2 ? 0.75 : 0.2);
    scene.lights << defaultLight(scene.canvas, x, y);
    mDocument.edit(tr("Add Light"), scene);
    mDocument.selectLight(mDocument.scene().lights.size() - 1);
}

void LightsSection::deleteLight()
{
    mDocument.edit(tr("Delete Light"), withoutLight(mDocument.scene(), mDocument.selectedLight()));
}

void LightsSection::changeLight(const QString& text, int gesture,
                                const std::function<void(AreaLight&)>& apply)
{
    Scene scene = mDocument.scene();
    const int selected = mDocument.selectedLight();
    if (selected < 0 || selected >= scene.lights.size())
        return;
    AreaLight& light = scene.lights[selected];
    const int frame = mHost.currentFrame();
    AreaLight shown = lightAt(light, frame);
    apply(shown);
    light = changedAt(light, frame, shown);
    mDocument.edit(text, scene, gesture);
}

void LightsSection::toggleKey()
{
    Scene scene = mDocument.scene();
    const int selected = mDocument.selectedLight();
    if (selected < 0 || selected >= scene.lights.size())
        return;
    AreaLight& light = scene.lights[selected];
    const int frame = mHost.currentFrame();
    const bool hasKey = keyFrames(light).contains(frame);
    light = hasKey ? withoutKey(light, frame) : withKey(light, frame);
    mDocument.edit(hasKey ? tr("Remove Key") : tr("Add Key"), scene);
}

} // namespace lampblack
