#include "tool/panel/render_section.h"

#include "tool/panel/ignore_wheel.h"

#include <QAction>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QPainter>
#include <QStandardItemModel>

#include <array>

namespace lampblack
{

namespace
{

/// A button that does what the action does, and rests when it rests.
QPushButton* buttonFor(QAction& action, const QString& name, QWidget* parent)
{
    auto* button = new QPushButton(action.text(), parent);
    button->setObjectName(name);
    button->setToolTip(action.toolTip());
    button->setAutoDefault(false);
    button->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
    QObject::connect(button, &QPushButton::clicked, &action, &QAction::trigger);
    QObject::connect(&action, &QAction::changed, button,
                     [button, &action] { button->setEnabled(action.isEnabled()); });
    return button;
}

struct Kind
{
    ApartKind apart;
    QString name;
    QString hint;
};

QVector<Kind> apartKinds()
{
    const auto tr = [](const char* text)
    {
        return RenderSection::tr(text);
    };
    return {{ApartKind::None, tr("One"), tr("The lit frames, in one layer")},
            {ApartKind::Pencil2d, tr("Apart"), tr("Layers of this project, in place of the layer \"Lit\"")},
            {ApartKind::Ora, tr("+ ORA"), tr("Beside each frame an OpenRaster file, for Krita and MyPaint")},
            {ApartKind::Png, tr("+ PNG"),
             tr("A folder of PNG files for each layer, to blend in another program")},
            {ApartKind::Exr, tr("EXR"),
             tr("Files with all layers, for Nuke and Blender; the project stays as it is")}};
}

} // namespace

RenderSection::RenderSection(Host& host, SceneDocument& document, QAction& surfaces, QAction& render,
                             QWidget* parent)
    : Section(QStringLiteral("lampblack.panel.render_section"), tr("Whole animation"), true, parent),
      mDocument(document), mRender(render), mRange(new QComboBox(this)), mQuality(new QComboBox(this)),
      mApart(new QComboBox(this)), mHide(new QCheckBox(tr("Hide the sources"), this)),
      mRenderAll(buttonFor(render, QStringLiteral("lampblack.panel.render"), this)),
      mOutdated(new QLabel(this)), mRenderChanged(new QPushButton(tr("Render What Changed"), this))
{
    mRange->setObjectName(QStringLiteral("lampblack.panel.range"));
    mRange->setAccessibleName(tr("Frames to render"));
    mRange->setToolTip(tr("The loop is the range set in the timeline."));
    mRange->addItems({tr("All"), tr("Loop"), tr("Current")});
    ignoreWheelWithoutFocus(mRange);
    mHide->setObjectName(QStringLiteral("lampblack.panel.hide"));
    mHide->setToolTip(tr("When all frames are in the layer \"Lit\", hide the drawings that were lit."));
    mQuality->setObjectName(QStringLiteral("lampblack.panel.quality"));
    mQuality->setAccessibleName(tr("Quality of rendered frames"));
    mQuality->setToolTip(tr("Quality of rendered frames. Higher: less noise and more detail, but slower."));
    mQuality->addItems({tr("Low"), tr("Medium"), tr("Final")});
    ignoreWheelWithoutFocus(mQuality);
    mApart->setObjectName(QStringLiteral("lampblack.panel.apart"));
    mApart->setAccessibleName(tr("Layers for compositing"));
    mApart->setToolTip(tr("Separate layers for compositing: shadow, shade, light, highlight, rim and glow. "
                          "Together they are the lit frame."));
    const QVector<Kind> kinds = apartKinds();
    for (const Kind& kind : kinds)
    {
        mApart->addItem(kind.name, int(kind.apart));
        mApart->setItemData(mApart->count() - 1, kind.hint, Qt::ToolTipRole);
    }
    ignoreWheelWithoutFocus(mApart);
    mOutdated->setObjectName(QStringLiteral("lampblack.panel.outdated"));
    mOutdated->setWordWrap(true);
    mRenderChanged->setObjectName(QStringLiteral("lampblack.panel.render_changed"));
    mRenderChanged->setToolTip(tr("Light only the frames whose drawing or light has changed."));
    mRenderChanged->setAutoDefault(false);
    mRenderChanged->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
    connect(&render, &QAction::changed, mRenderChanged,
            [this] { mRenderChanged->setEnabled(mRender.isEnabled()); });
    auto* choices = new QGridLayout;
    choices->setColumnStretch(0, 1);
    choices->addWidget(new QLabel(tr("Frames"), this), 0, 0);
    choices->addWidget(mRange, 0, 1);
    choices->addWidget(new QLabel(tr("Quality"), this), 1, 0);
    choices->addWidget(mQuality, 1, 1);
    choices->addWidget(new QLabel(tr("Layers"), this), 2, 0);
    choices->addWidget(mApart, 2, 1);
    body()->addWidget(buttonFor(surfaces, QStringLiteral("lampblack.panel.generate"), this));
    body()->addLayout(choices);
    body()->addWidget(mHide);
    body()->addWidget(mRenderAll);
    body()->addWidget(mOutdated);
    body()->addWidget(mRenderChanged);
    connect(mRenderChanged, &QPushButton::clicked, this, &RenderSection::renderChangedRequested);
    connect(mRange, qOverload<int>(&QComboBox::currentIndexChanged), this, &RenderSection::updateRenderText);
    connect(mQuality, qOverload<int>(&QComboBox::activated), this,
            [this](int index)
            {
                Scene scene = mDocument.scene();
                scene.quality = static_cast<Quality>(index);
                mDocument.edit(tr("Change Quality"), scene);
            });
    connect(&document, &SceneDocument::sceneChanged, this, &RenderSection::refresh);
    setOutdated(0, 0);
    if (!host.can(Host::Ability::Deliver))
        restrictToFiles(host.whyNot(Host::Ability::Deliver));
    refresh();
}

void RenderSection::restrictToFiles(const QString& reason)
{
    mHide->setEnabled(false);
    mHide->setToolTip(reason);
    auto* kinds = qobject_cast<QStandardItemModel*>(mApart->model());
    const int inProject = mApart->findData(int(ApartKind::Pencil2d));
    kinds->item(inProject)->setEnabled(false);
    kinds->item(inProject)->setToolTip(reason);
    kinds->item(mApart->findData(int(ApartKind::None)))->setToolTip(tr("The lit frames, as PNG files"));
}

ApartKind RenderSection::apart() const
{
    return static_cast<ApartKind>(mApart->currentData().toInt());
}

void RenderSection::updateRenderText()
{
    const std::array<QString, 3> names{tr("Render All Frames"), tr("Render Loop"), tr("Render This Frame")};
    mRenderAll->setText(names[size_t(range())]);
    mRender.setText(names[size_t(range())]);
}

void RenderSection::refresh()
{
    mQuality->setCurrentIndex(int(mDocument.scene().quality));
}

void RenderSection::setOutdated(int outdated, int total)
{
    mOutdated->setText(tr("%1 of %2 lit frames are out of date").arg(outdated).arg(total));
    mOutdated->setVisible(outdated > 0);
    mRenderChanged->setVisible(outdated > 0);
}

WorkerLine::WorkerLine(QWidget* parent) : QWidget(parent), mText(new QLabel(this))
{
    setObjectName(QStringLiteral("lampblack.panel.worker.line"));
    mText->setObjectName(QStringLiteral("lampblack.panel.worker"));
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(20, 2, 2, 2);
    row->addWidget(mText, 1);
    setState(Worker::State::Absent);
}

void WorkerLine::setState(Worker::State state)
{
    mState = state;
    refresh();
}

void WorkerLine::setLit(bool lit)
{
    mLit = lit;
    refresh();
}

void WorkerLine::refresh()
{
    const bool isWaiting = mState == Worker::State::Ready && !mLit;
    switch (isWaiting ? Worker::State::Busy : mState)
    {
    case Worker::State::Absent:
        mText->setText(tr("No light yet"));
        mDot = QColor(150, 150, 150);
        break;
    case Worker::State::Starting:
        mText->setText(tr("Starting…"));
        mDot = QColor(232, 170, 40);
        break;
    case Worker::State::Ready:
        mText->setText(tr("Ready"));
        mDot = QColor(74, 168, 88);
        break;
    case Worker::State::Busy:
        mText->setText(tr("Lighting…"));
        mDot = QColor(74, 168, 88);
        break;
    case Worker::State::Restarting:
        mText->setText(tr("Starting again…"));
        mDot = QColor(232, 170, 40);
        break;
    }
    update();
}

void WorkerLine::paintEvent(QPaintEvent*)
{
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(QColor(0, 0, 0, 90));
    painter.setBrush(mDot);
    painter.drawEllipse(QPointF(11, height() / 2.0), 4, 4);
}

} // namespace lampblack
