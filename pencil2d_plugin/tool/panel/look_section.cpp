#include "tool/panel/look_section.h"

#include "scene/style_place.h"
#include "tool/panel/ignore_wheel.h"
#include "tool/panel/look_picture.h"

#include <QHBoxLayout>

namespace lampblack
{

namespace
{

constexpr int IconSide = 34;
constexpr int MaxTones = 3; // thresholds: one less than tones

QString named(const QString& name)
{
    return QStringLiteral("lampblack.panel.look.") + name;
}

QString named(const char* name)
{
    return named(QString::fromLatin1(name));
}

} // namespace

LookSection::LookSection(SceneDocument& document, QWidget* parent)
    : Section(QStringLiteral("lampblack.panel.look"), tr("Look"), true, parent), mDocument(document),
      mChoices(new QButtonGroup(this)), mCount(new QComboBox(this))
{
    body()->addWidget(choices());
    body()->addWidget(toneCount());
    for (int tone = 0; tone < MaxTones; ++tone)
    {
        auto* row = new ValueRow(named("tone.") + QString::number(tone + 1), tr("Edge %1").arg(tone + 1),
                                 {0, 1, 1, 0, false, 2}, this);
        row->setHint(tr("Where the next darker tone begins: lower makes the shade smaller"));
        connect(row, &ValueRow::edited, this,
                [this, tone](double value, int gesture)
                {
                    change(tr("Change Tone"), gesture,
                           [&](Scene& scene)
                           {
                               if (tone < scene.look.tones.size())
                                   scene.look.tones[tone] = value;
                           });
                });
        mTones << row;
        body()->addWidget(row);
    }
    mSoftness = lookRow("softness", tr("Softness"), tr("How wide the edge of a tone is: 0 is a clean cut"),
                        &Look::softness);
    body()->addWidget(mSoftness);
    addMore();
    connect(&document, &SceneDocument::sceneChanged, this, &LookSection::refresh);
    refresh();
}

QWidget* LookSection::choices()
{
    auto* box = new QWidget(this);
    auto* row = new QHBoxLayout(box);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(0);
    const QVector<LookPicture> all = lookPictures();
    mChoices->setExclusive(false); // none is checked while the look is one's own
    for (const LookPicture& choice : all)
    {
        auto* button = new QToolButton(box);
        button->setObjectName(named(choice.id));
        button->setText(choice.name);
        button->setToolTip(choice.hint);
        button->setIcon(styleIcon(choice.style, IconSide, devicePixelRatioF()));
        button->setIconSize(QSize(IconSide, IconSide));
        button->setToolButtonStyle(Qt::ToolButtonTextUnderIcon);
        button->setCheckable(true);
        button->setAutoRaise(true);
        button->setFocusPolicy(Qt::StrongFocus);
        button->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
        mChoices->addButton(button, mChoices->buttons().size());
        row->addWidget(button, 1);
    }
    connect(mChoices, &QButtonGroup::idClicked, this,
            [this, all](int id)
            {
                change(tr("Change Look"), 0, [&](Scene& scene) { scene = withStyle(scene, all[id].style); });
                refresh(); // the click has toggled its button
            });
    return box;
}

QWidget* LookSection::toneCount()
{
    auto* box = new QWidget(this);
    auto* row = new QHBoxLayout(box);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(4);
    mCount->setObjectName(named("tones"));
    mCount->setAccessibleName(tr("Tones"));
    mCount->setToolTip(tr("Smooth light, or a number of flat tones with edges between them"));
    mCount->addItems({tr("Smooth"), tr("2 tones"), tr("3 tones"), tr("4 tones")});
    ignoreWheelWithoutFocus(mCount);
    row->addWidget(new QLabel(tr("Tones"), box));
    row->addStretch(1);
    row->addWidget(mCount);
    connect(mCount, qOverload<int>(&QComboBox::activated), this, &LookSection::setToneCount);
    return box;
}

void LookSection::addMore()
{
    auto* more = new Section(named("more"), tr("Shade and rim"), false, this);
    QVBoxLayout& rows = *more->body();
    rows.setContentsMargins(0, 0, 0, 0); // in line with the rows above
    mShade = new ColourButton(named("shade_colour"), tr("Colour of the shade"), this);
    rows.addWidget(colourRow(mShade, tr("Shade colour")));
    connect(mShade, &ColourButton::edited, this,
            [this](const QColor& colour, int gesture)
            { change(tr("Change Shade"), gesture, [&](Scene& scene) { scene.look.shadeColour = colour; }); });
    rows.addWidget(lookRow("shade", tr("Shade"),
                           tr("How strong the colour of the shade is. 0: only the light makes the shade"),
                           &Look::shadeStrength));
    addCastShadow(rows);
    rows.addWidget(lookRow("highlight", tr("Highlight"),
                           tr("With tones: where highlights begin. Lower makes larger highlights"),
                           &Look::highlight));
    rows.addWidget(lookRow("contact", tr("Contact"),
                           tr("Darkens where surfaces touch, such as an arm on a body"), &Look::contact));
    rows.addWidget(
        lookRow("ink", tr("Ink light"),
                tr("How much the light changes your line: darker in shade, coloured in light. 0: as drawn"),
                &Look::inkLight));
    rows.addWidget(lookRow("glow", tr("Glow"),
                           tr("Glow around colours that shine by themselves, such as a flame"), &Look::glow));
    addRim(rows);
    body()->addWidget(more);
}

void LookSection::addCastShadow(QVBoxLayout& rows)
{
    auto* colour = new ColourButton(named("cast_colour"), tr("Colour of cast shadows"), this);
    QWidget* head = colourRow(colour, tr("Cast shadow"));
    ValueRow* strength = lookRow("cast", tr("Strength"),
                                 tr("With tones: how strong the colour of cast shadows is, such as the "
                                    "shadow of an arm on the body. 0: as the shade"),
                                 &Look::castStrength);
    head->setToolTip(strength->toolTip());
    rows.addWidget(head);
    rows.addWidget(strength);
    connect(colour, &ColourButton::edited, this,
            [this](const QColor& chosen, int gesture) {
                change(tr("Change Cast Shadow"), gesture,
                       [&](Scene& scene) { scene.look.castColour = chosen; });
            });
    mShow << [colour, strength](const Scene& scene)
    {
        const bool hasTones = !scene.look.tones.isEmpty();
        colour->setEnabled(hasTones);
        strength->setEnabled(hasTones);
        colour->setColour(scene.look.castColour);
    };
}

void LookSection::addRim(QVBoxLayout& rows)
{
    mRim = new QCheckBox(tr("Rim"), this);
    mRim->setObjectName(named("rim_on"));
    mRim->setToolTip(tr("A line of light along the edges of the character, all around or on one side"));
    mRimColour = new ColourButton(named("rim_colour"), tr("Colour of the rim"), this);
    auto* head = new QWidget(this);
    auto* row = new QHBoxLayout(head);
    row->setContentsMargins(0, 0, 0, 0);
    row->addWidget(mRim);
    row->addStretch(1);
    row->addWidget(mRimColour);
    rows.addWidget(head);
    rows.addWidget(rimRow("rim_width", tr("Width"), tr("Width of the rim, in pixels of the canvas"),
                          {0.25, 200, 40, 2, false, 1}, &Rim::width));
    rows.addWidget(rimRow("rim_strength", tr("Strength"), tr("How strong the colour of the rim is"),
                          {0, 1, 1, 0, false, 2}, &Rim::strength));
    rows.addWidget(
        rimRow("rim_away", tr("One side"),
               tr("Where the rim is. 0: all around. 1: only on the side away from the strongest light"),
               {0, 1, 1, 0, false, 2}, &Rim::away));
    connect(mRim, &QCheckBox::clicked, this,
            [this](bool on)
            {
                change(on ? tr("Add Rim") : tr("Remove Rim"), 0,
                       [on](Scene& scene)
                       {
                           scene.rim.reset();
                           if (on)
                               scene.rim = Rim();
                       });
            });
    connect(mRimColour, &ColourButton::edited, this,
            [this](const QColor& colour, int gesture)
            {
                change(tr("Change Rim"), gesture,
                       [&](Scene& scene)
                       {
                           if (scene.rim)
                               scene.rim->colour = colour;
                       });
            });
}

ValueRow* LookSection::lookRow(const char* name, const QString& label, const QString& hint,
                               double Look::*field)
{
    auto* row = new ValueRow(named(name), label, {0, 1, 1, 0, false, 2}, this);
    row->setHint(hint);
    mShow << [row, field](const Scene& scene)
    {
        row->setValue(scene.look.*field);
    };
    connect(row, &ValueRow::edited, this,
            [this, label, field](double value, int gesture) {
                change(tr("Change %1").arg(label), gesture, [&](Scene& scene) { scene.look.*field = value; });
            });
    return row;
}

ValueRow* LookSection::rimRow(const char* name, const QString& label, const QString& hint,
                              const SliderScale& scale, double Rim::*field)
{
    auto* row = new ValueRow(named(name), label, scale, this);
    row->setHint(hint);
    mShow << [row, field](const Scene& scene)
    {
        row->setEnabled(scene.rim.has_value());
        row->setValue(scene.rim.value_or(Rim()).*field);
    };
    connect(row, &ValueRow::edited, this,
            [this, field](double value, int gesture)
            {
                change(tr("Change Rim"), gesture,
                       [&](Scene& scene)
                       {
                           if (scene.rim)
                               (*scene.rim).*field = value;
                       });
            });
    return row;
}

QWidget* LookSection::colourRow(ColourButton* button, const QString& label)
{
    auto* box = new QWidget(this);
    auto* row = new QHBoxLayout(box);
    row->setContentsMargins(0, 0, 0, 0);
    row->addWidget(new QLabel(label, box));
    row->addStretch(1);
    row->addWidget(button);
    return box;
}

void LookSection::refresh()
{
    const Scene& scene = mDocument.scene();
    const QVector<LookPicture> all = lookPictures();
    for (int choice = 0; choice < all.size(); ++choice)
        mChoices->button(choice)->setChecked(withStyle(scene, all[choice].style) == scene);
    const QVector<double>& tones = scene.look.tones;
    mCount->setCurrentIndex(tones.size());
    for (int tone = 0; tone < mTones.size(); ++tone)
    {
        mTones[tone]->setVisible(tone < tones.size());
        if (tone < tones.size())
            mTones[tone]->setValue(tones[tone]);
    }
    mSoftness->setVisible(!tones.isEmpty());
    for (const auto& show : qAsConst(mShow))
        show(scene);
    mShade->setColour(scene.look.shadeColour);
    mRim->setChecked(scene.rim.has_value());
    mRimColour->setEnabled(scene.rim.has_value());
    mRimColour->setColour(scene.rim.value_or(Rim()).colour);
}

void LookSection::setToneCount(int count)
{
    change(tr("Change Tones"), 0,
           [count](Scene& scene)
           {
               scene.look.tones.clear();
               for (int tone = 1; tone <= count; ++tone)
                   scene.look.tones << double(tone) / (count + 1);
           });
}

void LookSection::change(const QString& text, int gesture, const std::function<void(Scene&)>& apply)
{
    Scene scene = mDocument.scene();
    apply(scene);
    mDocument.edit(text, scene, gesture);
}

} // namespace lampblack
