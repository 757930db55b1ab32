#include "tool/materials/materials_dock.h"

#include "tool/materials/material_edit.h"

#include <QHBoxLayout>

namespace lampblack
{

namespace
{
constexpr int MaxOtherRows = 256; // rows; the scene may hold thousands
constexpr int MinLines = 4;       // of text, so that a colour is visible
} // namespace

MaterialsDock::MaterialsDock(SceneDocument& document)
    : QDockWidget(tr("Materials")), mDocument(document), mPick(new QToolButton), mEmptyLabel(new QLabel),
      mScroll(new QScrollArea), mFrameRows(new QVBoxLayout),
      mOtherSection(
          new Section(QStringLiteral("lampblack.materials.elsewhere"), tr("Not in this frame"), false))
{
    setObjectName(QStringLiteral("lampblack.materials"));
    mPick->setObjectName(QStringLiteral("lampblack.materials.pick"));
    mPick->setIcon(QIcon(QStringLiteral(":/lampblack/eyedropper.svg")));
    mPick->setToolTip(tr("Pick a colour on the canvas"));
    mPick->setAccessibleName(tr("Pick a colour on the canvas"));
    mPick->setCheckable(true);
    mPick->setAutoRaise(true);
    mPick->setFocusPolicy(Qt::StrongFocus);
    const QStringList titles{tr("Diffuse"), tr("Glossy")};
    for (const QString& title : titles)
        mColumnWidth = qMax(mColumnWidth, fontMetrics().horizontalAdvance(title) + 6);
    auto* heading = new QHBoxLayout;
    heading->setContentsMargins(6, 0, 2, 0);
    heading->setSpacing(6);
    heading->addWidget(mPick);
    heading->addStretch(1);
    for (const QString& title : titles)
    {
        auto* label = new QLabel(title);
        label->setAlignment(Qt::AlignCenter);
        label->setFixedWidth(mColumnWidth);
        heading->addWidget(label);
    }
    mEmptyLabel->setObjectName(QStringLiteral("lampblack.materials.empty"));
    mEmptyLabel->setWordWrap(true);
    mEmptyLabel->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    mEmptyLabel->setMargin(6);
    mFrameRows->setSpacing(0);
    mOtherSection->body()->setContentsMargins(0, 0, 0, 0);
    mOtherSection->body()->setSpacing(0);

    auto* rows = new QWidget;
    auto* column = new QVBoxLayout(rows);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(2);
    column->addLayout(heading);
    column->addWidget(mEmptyLabel);
    column->addLayout(mFrameRows);
    column->addWidget(mOtherSection);
    column->addStretch(1);
    mScroll->setFrameShape(QFrame::NoFrame);
    mScroll->setWidgetResizable(true);
    mScroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    mScroll->setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOn);
    mScroll->setWidget(rows);
    mScroll->setMinimumHeight(fontMetrics().height() * MinLines);
    setWidget(mScroll);

    connect(mPick, &QToolButton::clicked, this, &MaterialsDock::pickRequested);
    connect(&document, &SceneDocument::sceneChanged, this, &MaterialsDock::refresh);
    updateRows();
}

void MaterialsDock::setPalette(const QVector<Swatch>& swatches)
{
    QVector<QString> palette;
    for (const Swatch& swatch : swatches)
        palette << swatch.colour;
    if (palette == mPalette)
        return;
    mPalette = palette;
    updateRows();
}

void MaterialsDock::setHighlighted(const QString& colour)
{
    if (colour == mHighlighted)
        return;
    if (SwatchRow* before = mRows.value(mHighlighted))
        before->setHighlighted(false);
    mHighlighted = colour;
    if (SwatchRow* now = mRows.value(colour))
        now->setHighlighted(true);
}

void MaterialsDock::revealColour(const QString& colour)
{
    show();
    raise();
    if (mOtherColours.contains(colour))
        mOtherSection->setOpen(true);
    setHighlighted(colour);
    if (SwatchRow* found = mRows.value(colour))
    {
        mScroll->widget()->layout()->activate();
        mScroll->ensureWidgetVisible(found);
    }
}

void MaterialsDock::refresh()
{
    if (otherColours() != mOtherColours)
        updateRows();
    for (SwatchRow* each : qAsConst(mRows))
    {
        each->setMaterial(materialOf(mDocument.scene(), each->colour()));
        each->setCorrection(correctionOf(mDocument.scene(), each->colour()));
    }
}

QVector<QString> MaterialsDock::otherColours() const
{
    QVector<QString> colours;
    const QMap<QString, Material>& materials = mDocument.scene().materials;
    for (auto material = materials.begin(); material != materials.end() && colours.size() < MaxOtherRows;
         ++material)
    {
        if (!mPalette.contains(material.key()))
            colours << material.key();
    }
    return colours;
}

void MaterialsDock::updateRows()
{
    mOtherColours = otherColours();
    for (auto each = mRows.begin(); each != mRows.end();)
    {
        if (mPalette.contains(each.key()) || mOtherColours.contains(each.key()))
        {
            ++each;
            continue;
        }
        each.value()->hide();
        each.value()->deleteLater();
        each = mRows.erase(each);
    }
    for (int place = 0; place < mPalette.size(); ++place)
        mFrameRows->insertWidget(place, rowFor(mPalette[place]));
    for (int place = 0; place < mOtherColours.size(); ++place)
        mOtherSection->body()->insertWidget(place, rowFor(mOtherColours[place]));
    mEmptyLabel->setVisible(mPalette.isEmpty());
    mOtherSection->setVisible(!mOtherColours.isEmpty());
    mOtherSection->setTitle(tr("Not in this frame (%1)").arg(mOtherColours.size()));
}

SwatchRow* MaterialsDock::rowFor(const QString& colour)
{
    SwatchRow*& found = mRows[colour];
    if (found == nullptr)
    {
        found = new SwatchRow(colour, mColumnWidth, mScroll->widget());
        found->setMaterial(materialOf(mDocument.scene(), colour));
        found->setCorrection(correctionOf(mDocument.scene(), colour));
        found->setHighlighted(colour == mHighlighted);
        connect(
            found, &SwatchRow::corrected, this,
            [this](const DepthColour& correction, int gesture)
            { mDocument.edit(tr("Change Volume"), withCorrection(mDocument.scene(), correction), gesture); });
        connect(found, &SwatchRow::edited, this,
                [this](const QString& edited, const Material& material, int gesture) {
                    mDocument.edit(tr("Change Material"), withMaterial(mDocument.scene(), edited, material),
                                   gesture);
                });
        found->show();
    }
    return found;
}

} // namespace lampblack
