#include "tool/panel/lights_section.h"

#include "scene/timeline.h"
#include "tool/canvas/key_input.h"
#include "tool/panel/light_numbers.h"
#include "tool/panel/rig_menu.h"

#include <QHBoxLayout>

namespace lampblack
{

namespace
{
constexpr double CopyDistance = 0.08; // of half the canvas's long side
}

LightsSection::LightsSection(Host& host, SceneDocument& document, QWidget* parent)
    : Section(QStringLiteral("lampblack.panel.lights"), tr("Lights"), true, parent), mHost(host),
      mDocument(document)
{
    auto* list = new QVBoxLayout;
    list->setSpacing(0);
    body()->addLayout(list);
    for (int light = 0; light < MaxLights; ++light)
    {
        addRow(light);
        list->addWidget(mRows[size_t(light)]);
    }
    addButtons();
    body()->addWidget(new LightNumbers(host, document, this));
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

void LightsSection::addRow(int light)
{
    auto* row = new LightRow(light + 1, this);
    mRows[size_t(light)] = row;
    connect(row, &LightRow::selected, this,
            [this, light]
            {
                mDocument.selectLight(light);
                refresh(); // the click has toggled its button
            });
    connect(row, &LightRow::renamed, this,
            [this, light](const QString& name)
            { changeLight(light, tr("Name Light"), [&](AreaLight& each) { each.name = name; }); });
    connect(row, &LightRow::switched, this,
            [this, light](bool on)
            {
                changeLight(light, on ? tr("Switch Light On") : tr("Switch Light Off"),
                            [&](AreaLight& each) { each.on = on; });
            });
    connect(row, &LightRow::soloed, this,
            [this, light](bool solo)
            {
                changeLight(light, solo ? tr("Solo Light") : tr("End Solo"),
                            [&](AreaLight& each) { each.solo = solo; });
            });
}

void LightsSection::addButtons()
{
    const auto add = [this](const char* name, const QString& text, const QString& hint)
    {
        return smallButton(QStringLiteral("lampblack.panel.light.") + QLatin1String(name), text, hint, this);
    };
    mAdd = add("add", tr("Add"), tr("Add a light"));
    mDuplicate = add("duplicate", tr("Duplicate"), tr("A second light like the selected one"));
    mDelete = add("delete", tr("Delete"), tr("Delete the selected light"));
    mRigs =
        add("rigs", tr("Sets"),
            tr("Sets of lights that are ready to use; save these lights, or copy them to another project"));
    auto* rigs = new RigMenu(mHost, mDocument, this);
    connect(rigs, &RigMenu::problem, this, &LightsSection::problem);
    mRigs->setMenu(rigs);
    mRigs->setPopupMode(QToolButton::InstantPopup);
    auto* row = new QHBoxLayout;
    row->setSpacing(0);
    for (QToolButton* button : {mAdd, mDuplicate, mDelete, mRigs})
    {
        // Widths are proportional to the lengths of the words, and fill the panel.
        button->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
        row->addWidget(button, int(button->text().size()) + 2);
    }
    body()->addLayout(row);
    connect(mAdd, &QToolButton::clicked, this, &LightsSection::addLight);
    connect(mDuplicate, &QToolButton::clicked, this, &LightsSection::duplicateLight);
    connect(
        mDelete, &QToolButton::clicked, this,
        [this]
        { mDocument.edit(tr("Delete Light"), withoutLight(mDocument.scene(), mDocument.selectedLight())); });
}

void LightsSection::refresh()
{
    const Scene scene = sceneAt(mDocument.scene(), mHost.currentFrame());
    const int selected = mDocument.selectedLight();
    for (int light = 0; light < MaxLights; ++light)
    {
        LightRow* row = mRows[size_t(light)];
        row->setVisible(light < scene.lights.size());
        if (light < scene.lights.size())
            row->setLight(scene.lights[light], light == selected);
    }
    const bool hasRoom = scene.lights.size() < MaxLights;
    const bool hasLight = selected >= 0 && selected < scene.lights.size();
    mAdd->setEnabled(hasRoom);
    mDuplicate->setEnabled(hasRoom && hasLight);
    mDelete->setEnabled(hasLight);
}

void LightsSection::addLight()
{
    Scene scene = mDocument.scene();
    if (scene.lights.size() >= MaxLights)
        return;
    // Each light starts at another place, so that none hides another.
    const int place = scene.lights.size();
    const double x = scene.canvas.width * (place % 2 ? 0.75 : 0.25);
    const double y = scene.canvas.height * (0.2 + 0.2 * (place / 2));
    scene.lights << defaultLight(scene.canvas, x, y);
    mDocument.edit(tr("Add Light"), scene);
    mDocument.selectLight(mDocument.scene().lights.size() - 1);
}

void LightsSection::duplicateLight()
{
    const int selected = mDocument.selectedLight();
    const int before = mDocument.scene().lights.size();
    mDocument.edit(tr("Duplicate Light"), withCopy(mDocument.scene(), selected));
    if (mDocument.scene().lights.size() > before)
        mDocument.selectLight(selected + 1);
}

void LightsSection::changeLight(int light, const QString& text, const std::function<void(AreaLight&)>& apply)
{
    Scene scene = mDocument.scene();
    if (light >= scene.lights.size())
        return;
    apply(scene.lights[light]);
    mDocument.edit(text, scene);
    refresh(); // a button that was clicked shows the scene, also if nothing has changed
}

Scene withCopy(Scene scene, int light)
{
    if (light < 0 || light >= scene.lights.size() || scene.lights.size() >= MaxLights)
        return scene;
    AreaLight copy = scene.lights[light];
    const double aside = CopyDistance * defaultHeight(scene.canvas);
    copy.x += aside;
    copy.y += aside;
    for (LightKey& key : copy.keys)
    {
        key.x += aside;
        key.y += aside;
    }
    if (!copy.name.isEmpty())
        copy.name = LightsSection::tr("%1 copy").arg(copy.name);
    scene.lights.insert(light + 1, copy);
    return scene;
}

} // namespace lampblack
